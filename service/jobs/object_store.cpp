#include "service/jobs/object_store.h"

#include <algorithm>

#include "core/base/hex.h"
#include "core/io/posix_file.h"
#include "core/io/sha256.h"

namespace farhorizon {

bool IsSha256(const std::string& text) {
  return text.size() == 64 && std::all_of(text.begin(), text.end(), IsLowerHexDigit);
}

Status ObjectStore::RemoveAll(const std::vector<std::string>& names) {
  for (const std::string& name : names) {
    Status removed = Remove(name);
    if (!removed) return removed;
  }
  return Ok{};
}

Result<StoredObject> CopyAndHash(int from, int to) {
  Sha256 hash;
  StoredObject object;
  Status copied = ForEachPiece(from, "read", [&](std::string_view piece) -> Status {
    hash.Add(piece);
    object.bytes += static_cast<std::int64_t>(piece.size());
    if (!WriteAll(to, piece)) return StorageError("write");
    return Ok{};
  });
  if (!copied) return std::move(copied.error());
  object.sha256 = hash.Finish().Hex();
  return object;
}

}  // namespace farhorizon
