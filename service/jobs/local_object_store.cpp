// write temp -> fsync -> rename into place -> fsync the folder: an object is there whole or not.
#include "service/jobs/local_object_store.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <cerrno>
#include <fcntl.h>
#include <string>
#include <sys/stat.h>
#include <unistd.h>
#include <utility>

#include "core/io/sha256.h"
#include "service/jobs/durable_file.h"

namespace farhorizon {

bool IsSha256(const std::string& text) {
  return text.size() == 64 && std::all_of(text.begin(), text.end(), [](char c) {
           return (c >= '0' && c <= '9') || (c >= 'a' && c <= 'f');
         });
}

namespace {

namespace fs = std::filesystem;

constexpr std::size_t kPieceBytes = std::size_t{1} << 18U;

/// Hashes what `from` has, writing it to `to` too unless that is negative.
Result<StoredObject> Drain(int from, int to) {
  Sha256 hash;
  StoredObject object;
  std::string piece(kPieceBytes, '\0');
  for (;;) {
    const ssize_t size = ::read(from, piece.data(), piece.size());
    if (size < 0 && errno == EINTR) continue;
    if (size < 0) return FileError("read");
    if (size == 0) break;
    const std::string_view bytes(piece.data(), static_cast<std::size_t>(size));
    hash.Add(bytes);
    object.bytes += size;
    if (to < 0) continue;
    Status written = WriteAll(to, bytes);
    if (!written) return std::move(written.error());
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
    // A private copy under our own name: whoever made `file` cannot change what is stored. The
    // worker's process is gone by then, but a descriptor of a child of its own might not be.
    const fs::path temp = root_ / "temp" / std::to_string(next_temp_++);
    UniqueFd copy(::open(temp.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC | O_NOFOLLOW, 0400));
    if (!copy) return FileError("make an object");
    Result<StoredObject> object = Drain(source->get(), copy.get());
    Status placed = Done{};
    if (!object) {
      placed = std::move(object.error());
    } else if (::fsync(copy.get()) != 0) {
      placed = FileError("sync an object");
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
    if (::fstat(fd->get(), &info) != 0) return FileError("look at an object");
    return OpenObject{*std::move(fd), info.st_size};
  }

  Status Materialise(const std::string& sha256, const fs::path& target) override {
    Result<OpenObject> object = Open(sha256);
    if (!object) return std::move(object.error());
    const UniqueFd copy(::open(target.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0400));
    if (!copy) return FileError("make the worker's input");
    Result<StoredObject> copied = Drain(object->fd.get(), copy.get());
    if (!copied) return std::move(copied.error());
    if (copied->sha256 != sha256) {
      return Error{ErrorCode::kIo, "the stored upload is damaged; send it again", "input-corrupt"};
    }
    return Done{};
  }

  Status Remove(const std::string& sha256) override {
    Check(IsSha256(sha256), "an object's name is a SHA-256");
    if (::unlink(PathOf(sha256).c_str()) != 0 && errno != ENOENT) {
      return FileError("remove an object");
    }
    return Done{};
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
      Status synced = SyncDirectory(root_);
      if (!synced) return synced;
    } else if (errno != EEXIST) {
      return FileError("make a folder of objects");
    }
    if (::rename(temp.c_str(), target.c_str()) != 0) return FileError("place an object");
    return SyncDirectory(target.parent_path());
  }

  fs::path root_;
  std::atomic<std::int64_t> next_temp_{0};
};

}  // namespace

Result<std::unique_ptr<ObjectStore>> OpenLocalObjectStore(const fs::path& root) {
  std::error_code failure;
  fs::remove_all(root / "temp", failure);  // left by a process that was killed
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
