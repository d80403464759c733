#include "service/jobs/gzip_copy.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

// For input that zlib reads and does not change.
#define ZLIB_CONST
#include <zlib.h>

#include "core/io/posix_file.h"
#include "service/jobs/spool_file.h"
#include "service/jobs/storage_file.h"

namespace farhorizon {

namespace {

// What saves less is not worth its file: a block of a usual file system.
constexpr std::int64_t kLeastSaving = 4096;
// Draco's bytes do not get smaller: a look at the first of them is enough to know.
constexpr std::size_t kLook = std::size_t{256} << 10U;

bool Pays(std::int64_t bytes, std::int64_t copy) {
  return bytes - copy >= std::max(kLeastSaving, bytes / 10);
}

// Bytes in, the same as gzip out. Neither a name nor a time is in it.
class Deflater {
 public:
  using Sink = std::function<Status(std::string_view piece)>;

  explicit Deflater(Sink sink) : sink_(std::move(sink)) {
    constexpr int kGzip = 16;  // added to the window's bits: a gzip head in place of zlib's
    constexpr int kMemory = 8;
    ready_ = ::deflateInit2(&stream_, Z_DEFAULT_COMPRESSION, Z_DEFLATED, MAX_WBITS + kGzip, kMemory,
                            Z_DEFAULT_STRATEGY) == Z_OK;
  }
  Deflater(const Deflater&) = delete;
  Deflater& operator=(const Deflater&) = delete;
  ~Deflater() {
    if (ready_) ::deflateEnd(&stream_);
  }

  /// flush: Z_NO_FLUSH; Z_SYNC_FLUSH to have all out that is in; Z_FINISH for the last bytes.
  Status Add(std::string_view bytes, int flush) {
    if (!ready_) {
      return Error{ErrorCode::kResourceExhausted, "no memory to compress a result",
                   "resource-exhausted"};
    }
    stream_.next_in = reinterpret_cast<const Bytef*>(bytes.data());
    stream_.avail_in = static_cast<uInt>(bytes.size());
    // Room that is left says that all has been taken.
    do {
      stream_.next_out = out_.data();
      stream_.avail_out = static_cast<uInt>(out_.size());
      ::deflate(&stream_, flush);
      const std::size_t made = out_.size() - stream_.avail_out;
      if (made == 0) break;
      Status taken = sink_({reinterpret_cast<const char*>(out_.data()), made});
      if (!taken) return taken;
    } while (stream_.avail_out == 0);
    return Ok{};
  }

 private:
  Sink sink_;
  z_stream stream_{};
  bool ready_ = false;
  std::array<Bytef, 65536> out_{};
};

// Writes the object as gzip to `copy`; false, with a part of it, where the look says that it does
// not pay.
Result<bool> Compress(const OpenObject& object, SpoolFile& copy) {
  Deflater deflater([&copy](std::string_view piece) { return copy.Write(piece); });
  std::string piece(kLook, '\0');
  for (bool first = true;; first = false) {
    const std::int64_t size = ReadSome(object.fd.get(), piece);
    if (size < 0) return StorageError("read a result");
    if (size == 0) break;
    const std::string_view bytes =
        std::string_view(piece).substr(0, static_cast<std::size_t>(size));
    Status added = deflater.Add(bytes, first ? Z_SYNC_FLUSH : Z_NO_FLUSH);
    if (!added) return std::move(added.error());
    if (first && !Pays(size, copy.bytes())) return false;
  }
  Status finished = deflater.Add({}, Z_FINISH);
  if (!finished) return std::move(finished.error());
  return Pays(object.bytes, copy.bytes());
}

Result<std::optional<StoredObject>> PutCopy(const Artifact& artifact, ObjectStore& objects,
                                            const std::filesystem::path& directory) {
  Result<OpenObject> object = objects.Open(artifact.sha256);
  if (!object) return std::move(object.error());
  Result<SpoolFile> copy = SpoolFile::Create(directory);
  if (!copy) return std::move(copy.error());
  Result<bool> pays = Compress(*object, *copy);
  if (!pays) return std::move(pays.error());
  if (!*pays) return std::optional<StoredObject>();
  Result<StoredObject> stored = objects.PutFile(copy->path());
  if (!stored) return std::move(stored.error());
  return std::optional(*std::move(stored));
}

}  // namespace

Status AddGzipCopies(std::vector<Artifact>& artifacts, ObjectStore& objects,
                     const std::filesystem::path& directory) {
  for (Artifact& artifact : artifacts) {
    if (artifact.bytes < kLeastSaving) continue;
    Result<std::optional<StoredObject>> copy = PutCopy(artifact, objects, directory);
    if (!copy) return std::move(copy.error());
    artifact.gzip = *std::move(copy);
  }
  return Ok{};
}

}  // namespace farhorizon
