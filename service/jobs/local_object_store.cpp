// An object appears whole or not at all: write a temporary file, fsync it, rename it into place,
// fsync the folder.
#include "service/jobs/local_object_store.h"

#include <atomic>
#include <cerrno>
#include <fcntl.h>
#include <string>
#include <sys/stat.h>
#include <unistd.h>
#include <utility>

#include "core/io/posix_file.h"
#include "core/io/sha256.h"
#include "service/jobs/storage_file.h"

namespace farhorizon {

namespace {

namespace fs = std::filesystem;

constexpr std::size_t kPieceBytes = std::size_t{1} << 18U;

// Copies all bytes of `from` to `to`; their SHA-256 and number.
Result<StoredObject> CopyAndHash(int from, int to) {
  Sha256 hash;
  StoredObject object;
  std::string piece(kPieceBytes, '\0');
  for (;;) {
    const std::int64_t size = ReadSome(from, piece);
    if (size < 0) return StorageError("read");
    if (size == 0) break;
    const std::string_view bytes(piece.data(), static_cast<std::size_t>(size));
    hash.Add(bytes);
    object.bytes += size;
    if (!WriteAll(to, bytes)) return StorageError("write");
  }
  object.sha256 = hash.Finish().Hex();
  return object;
}

class LocalObjectStore : public ObjectStore {
 public:
  explicit LocalObjectStore(fs::path root) : root_(std::move(root)) {}

  Result<StoredObject> PutFile(const fs::path& file) override {
    Result<UniqueFd> source = OpenForReading(file);
    if (!source) return std::move(source.error());
    // The copy is private: whoever made `file` cannot change the stored bytes. The worker has ended
    // by now, but a process that it started may still hold a descriptor of `file`.
    const fs::path temp = root_ / "temp" / std::to_string(next_temp_++);
    UniqueFd copy(::open(temp.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC | O_NOFOLLOW, 0400));
    if (!copy) return StorageError("make an object");
    Result<StoredObject> object = CopyAndHash(source->get(), copy.get());
    Status placed = Ok{};
    if (!object) {
      placed = std::move(object.error());
    } else if (::fsync(copy.get()) != 0) {
      placed = StorageError("sync an object");
    } else {
      placed = Place(temp, object->sha256);
    }
    if (!placed) {
      ::unlink(temp.c_str());
      return std::move(placed.error());
    }
    ::unlink(file.c_str());
    return object;
  }

  Result<OpenObject> Open(const std::string& sha256) override {
    if (!IsSha256(sha256)) return Error{ErrorCode::kNotFound, "no such object"};
    Result<UniqueFd> fd = OpenForReading(PathOf(sha256));
    if (!fd) return std::move(fd.error());
    struct stat info {};
    if (::fstat(fd->get(), &info) != 0) return StorageError("look at an object");
    return OpenObject{*std::move(fd), info.st_size};
  }

  Status CopyTo(const std::string& sha256, const fs::path& target) override {
    Result<OpenObject> object = Open(sha256);
    if (!object) return std::move(object.error());
    const UniqueFd copy(::open(target.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0400));
    if (!copy) return StorageError("make the worker's input");
    Result<StoredObject> copied = CopyAndHash(object->fd.get(), copy.get());
    if (!copied) return std::move(copied.error());
    if (copied->sha256 != sha256) {
      return Error{ErrorCode::kIo, "the stored upload is damaged; send it again", "input-corrupt"};
    }
    return Ok{};
  }

  Status Remove(const std::string& sha256) override {
    Check(IsSha256(sha256), "an object's name is a SHA-256");
    if (::unlink(PathOf(sha256).c_str()) != 0 && errno != ENOENT) {
      return StorageError("remove an object");
    }
    return Ok{};
  }

  Result<std::vector<std::string>> List() override {
    std::vector<std::string> names;
    std::error_code failure;
    for (fs::recursive_directory_iterator it(root_, failure), end; !failure && it != end;
         it.increment(failure)) {
      const std::string name = it->path().filename().string();
      if (IsSha256(name)) names.push_back(name);
    }
    if (failure) return Error{ErrorCode::kIo, "list objects: " + failure.message(), "storage"};
    return names;
  }

 private:
  [[nodiscard]] fs::path PathOf(const std::string& sha256) const {
    return root_ / sha256.substr(0, 2) / sha256;
  }

  Status Place(const fs::path& temp, const std::string& sha256) {
    const fs::path target = PathOf(sha256);
    if (::mkdir(target.parent_path().c_str(), 0700) == 0) {
      if (!SyncDirectory(root_)) return StorageError("sync a folder");
    } else if (errno != EEXIST) {
      return StorageError("make a folder of objects");
    }
    if (::rename(temp.c_str(), target.c_str()) != 0) return StorageError("place an object");
    if (!SyncDirectory(target.parent_path())) return StorageError("sync a folder");
    return Ok{};
  }

  fs::path root_;
  std::atomic<std::int64_t> next_temp_{0};
};

}  // namespace

Result<std::unique_ptr<ObjectStore>> OpenLocalObjectStore(const fs::path& root) {
  std::error_code failure;
  fs::remove_all(root / "temp", failure);  // files of a process that was killed
  fs::create_directories(root / "temp", failure);
  if (failure) {
    return Error{ErrorCode::kIo,
                 "object store: cannot make " + (root / "temp").string() + ": " +
                     failure.message() + "; give a data directory that can be written",
                 "storage"};
  }
  return std::unique_ptr<ObjectStore>(std::make_unique<LocalObjectStore>(root));
}

}  // namespace farhorizon
