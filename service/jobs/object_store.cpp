#include "service/jobs/object_store.h"

#include <algorithm>
#include <fcntl.h>
#include <sys/stat.h>
#include <utility>

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

Result<OpenObject> OpenObjectFile(const std::filesystem::path& file) {
  Result<UniqueFd> fd = OpenForReading(file);
  if (!fd) return std::move(fd.error());
  struct stat info {};
  if (::fstat(fd->get(), &info) != 0) return StorageError("look at an object");
  return OpenObject{*std::move(fd), info.st_size};
}

Status CopyObject(const OpenObject& object, const std::string& sha256,
                  const std::filesystem::path& target) {
  const UniqueFd copy(::open(target.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0400));
  if (!copy) return StorageError("make the worker's input");
  Result<StoredObject> copied = CopyAndHash(object.fd.get(), copy.get());
  if (!copied) return std::move(copied.error());
  if (copied->sha256 == sha256) return Ok{};
  return Error{ErrorCode::kIo, "the stored upload is damaged; send it again", "input-corrupt"};
}

}  // namespace farhorizon
