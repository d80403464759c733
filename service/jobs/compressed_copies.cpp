#include "service/jobs/compressed_copies.h"

#include <algorithm>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

#include "core/io/posix_file.h"
#include "service/jobs/compressor.h"
#include "service/jobs/spool_file.h"
#include "service/jobs/storage_file.h"

namespace farhorizon {

namespace {

using Flush = Compressor::Flush;

// What saves less is not worth its file: a block of a usual file system.
constexpr std::int64_t kLeastSaving = 4096;
// Draco's bytes do not get smaller: a look at the first of them is enough to know.
constexpr std::size_t kLook = std::size_t{256} << 10U;
// zstd is slow at the level at which it pays, and nothing interrupts it.
constexpr std::int64_t kMostInZstd = std::int64_t{32} << 20U;

bool Pays(std::int64_t bytes, std::int64_t copy) {
  return bytes - copy >= std::max(kLeastSaving, bytes / 10);
}

// Writes the object, compressed, to `copy`; false, with a part of it, where the look at its first
// bytes says that it does not pay.
Result<bool> Compress(const OpenObject& object, Coding coding, SpoolFile& copy) {
  const std::unique_ptr<Compressor> compressor =
      MakeCompressor(coding, [&copy](std::string_view piece) { return copy.Write(piece); });
  std::string piece(kLook, '\0');
  for (bool first = true;; first = false) {
    const std::int64_t size = ReadSome(object.fd.get(), piece);
    if (size < 0) return StorageError("read a result");
    if (size == 0) break;
    const std::string_view bytes =
        std::string_view(piece).substr(0, static_cast<std::size_t>(size));
    Status added = compressor->Add(bytes, first ? Flush::kAll : Flush::kNone);
    if (!added) return std::move(added.error());
    if (first && !Pays(size, copy.bytes())) return false;
  }
  Status finished = compressor->Add({}, Flush::kEnd);
  if (!finished) return std::move(finished.error());
  return true;
}

// The artifact in `coding`, where that pays beside something of `bytes` bytes.
Result<std::optional<StoredObject>> PutCopy(const Artifact& artifact, Coding coding,
                                            std::int64_t bytes, ObjectStore& objects,
                                            const std::filesystem::path& directory) {
  Result<OpenObject> object = objects.Open(artifact.sha256);
  if (!object) return std::move(object.error());
  Result<SpoolFile> copy = SpoolFile::Create(directory);
  if (!copy) return std::move(copy.error());
  Result<bool> compressed = Compress(*object, coding, *copy);
  if (!compressed) return std::move(compressed.error());
  if (!*compressed || !Pays(bytes, copy->bytes())) return std::optional<StoredObject>();
  Result<StoredObject> stored = objects.PutFile(copy->path());
  if (!stored) return std::move(stored.error());
  return std::optional(*std::move(stored));
}

}  // namespace

Status AddCompressedCopies(std::vector<Artifact>& artifacts, ObjectStore& objects,
                           const std::filesystem::path& directory) {
  for (Artifact& artifact : artifacts) {
    if (artifact.bytes < kLeastSaving) continue;
    auto gzip = PutCopy(artifact, Coding::kGzip, artifact.bytes, objects, directory);
    if (!gzip) return std::move(gzip.error());
    artifact.gzip = *std::move(gzip);
    if (!artifact.gzip || artifact.bytes > kMostInZstd) continue;
    auto zstd = PutCopy(artifact, Coding::kZstd, artifact.gzip->bytes, objects, directory);
    if (!zstd) return std::move(zstd.error());
    artifact.zstd = *std::move(zstd);
  }
  return Ok{};
}

}  // namespace farhorizon
