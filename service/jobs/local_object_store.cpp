// An object appears whole or not at all: write a temporary file, fsync it, name it as incoming,
// rename it into place, fsync the folder. The name as incoming need not be durable: a power cut
// that loses it makes a stray of an object that was never acknowledged.
#include "service/jobs/local_object_store.h"

#include <atomic>
#include <cerrno>
#include <chrono>
#include <fcntl.h>
#include <string>
#include <sys/stat.h>
#include <unistd.h>
#include <utility>

#include "core/base/hex.h"
#include "core/io/file.h"
#include "core/io/posix_file.h"
#include "service/jobs/storage_file.h"
#include "service/random.h"

namespace farhorizon {

namespace {

namespace fs = std::filesystem;

constexpr std::size_t kFolderDigits = 2;
constexpr std::uintmax_t kLargestLabel = 4096;

// Adds the names of the objects that stand in `folder`.
Status AddNames(const fs::path& folder, std::vector<std::string>& names) {
  std::error_code failure;
  for (fs::directory_iterator it(folder, failure), end; !failure && it != end;
       it.increment(failure)) {
    const std::string name = it->path().filename().string();
    if (IsSha256(name)) names.push_back(name);
  }
  if (failure) return Error{ErrorCode::kIo, "list objects: " + failure.message(), "storage"};
  return Ok{};
}

// Removes files that nobody has written to for a day.
void RemoveOld(const fs::path& folder) {
  std::error_code failure;
  const auto old = fs::file_time_type::clock::now() - std::chrono::hours(24);
  for (fs::directory_iterator it(folder, failure), end; !failure && it != end;
       it.increment(failure)) {
    std::error_code ignored;  // another one has removed it
    const auto written = fs::last_write_time(it->path(), ignored);
    if (!ignored && written < old) fs::remove(it->path(), ignored);
  }
}

class LocalObjectStore : public ObjectStore {
 public:
  LocalObjectStore(fs::path root, Sharing sharing) : root_(std::move(root)), sharing_(sharing) {}

  Result<StoredObject> PutFile(const fs::path& file) override;
  void Keep(const std::vector<std::string>& names) override;
  Result<OpenObject> Open(const std::string& sha256) override;
  Status CopyTo(const std::string& sha256, const fs::path& target) override;
  Status Remove(const std::string& sha256) override;
  Status SetAside(const std::string& sha256) override;
  Status TakeBack(const std::string& sha256) override;
  Result<std::vector<std::string>> List(ObjectList which) override;
  Result<std::string> Label() override { return ReadLabel(root_); }
  Status SetLabel(const std::string& label) override { return WriteLabel(root_, label); }
  Result<std::string> ClaimLabel(const std::string& label) override;
  Status CheckWrites() override;
  Result<DiskRoom> Room() override { return RoomOf(root_); }

 private:
  [[nodiscard]] fs::path PathOf(const std::string& sha256) const {
    return root_ / sha256.substr(0, kFolderDigits) / sha256;
  }
  [[nodiscard]] fs::path IncomingName(const std::string& sha256) const {
    return root_ / "incoming" / sha256;
  }
  // The error for an object that is not there: of the object, or of all where the folder is gone.
  [[nodiscard]] Error Missing() const;
  Status Place(const fs::path& temp, const std::string& sha256);
  Status Move(const fs::path& from, const fs::path& to);

  fs::path root_;
  Sharing sharing_;
  // What other processes name theirs otherwise by.
  const std::string temp_prefix_ = ToHex(RandomBytes()) + "-";
  std::atomic<std::int64_t> next_temp_{0};
};

Result<StoredObject> LocalObjectStore::PutFile(const fs::path& file) {
  Result<UniqueFd> source = OpenForReading(file);
  if (!source) return std::move(source.error());
  // The copy is private: whoever made `file` cannot change the stored bytes. The worker has ended
  // by now, but a process that it started may still hold a descriptor of `file`.
  const fs::path temp = root_ / "temp" / (temp_prefix_ + std::to_string(next_temp_++));
  UniqueFd copy(::open(temp.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC | O_NOFOLLOW, 0400));
  if (!copy) return StorageError("make an object");
  Result<StoredObject> object = CopyAndHash(source->get(), copy.get());
  Status placed = object ? SyncFile(copy.get(), "sync an object") : Status(object.error());
  if (placed) placed = Place(temp, object->sha256);
  if (!placed) {
    ::unlink(temp.c_str());
    return std::move(placed.error());
  }
  ::unlink(file.c_str());
  return object;
}

Status LocalObjectStore::Place(const fs::path& temp, const std::string& sha256) {
  if (::link(temp.c_str(), IncomingName(sha256).c_str()) != 0 && errno != EEXIST) {
    return StorageError("name an object");
  }
  return Move(temp, PathOf(sha256));
}

void LocalObjectStore::Keep(const std::vector<std::string>& names) {
  // A name that stays is taken off at the next start.
  for (const std::string& name : names) ::unlink(IncomingName(name).c_str());
}

Result<OpenObject> LocalObjectStore::Open(const std::string& sha256) {
  if (!IsSha256(sha256)) return Error{ErrorCode::kNotFound, "no such object"};
  Result<OpenObject> object = OpenObjectFile(PathOf(sha256));
  if (!object && object.error().code == ErrorCode::kNotFound) return Missing();
  return object;
}

Error LocalObjectStore::Missing() const {
  if (::access((root_ / "incoming").c_str(), F_OK) == 0) {
    return Error{ErrorCode::kNotFound, "no such object"};
  }
  return Error{ErrorCode::kIo,
               "the folder of objects " + root_.string() + " is gone; mount it again", "storage"};
}

Status LocalObjectStore::CopyTo(const std::string& sha256, const fs::path& target) {
  Result<OpenObject> object = Open(sha256);
  if (!object) return std::move(object.error());
  return CopyObject(*object, sha256, target);
}

Status LocalObjectStore::Remove(const std::string& sha256) {
  Check(IsSha256(sha256), "an object's name is a SHA-256");
  // The other name last: what a kill leaves is then still known to be incoming.
  for (const fs::path& name : {PathOf(sha256), IncomingName(sha256)}) {
    if (::unlink(name.c_str()) != 0 && errno != ENOENT) return StorageError("remove an object");
  }
  return Ok{};
}

Status LocalObjectStore::SetAside(const std::string& sha256) {
  return Move(PathOf(sha256), root_ / "stray" / sha256);
}

Status LocalObjectStore::TakeBack(const std::string& sha256) {
  return Move(root_ / "stray" / sha256, PathOf(sha256));
}

Result<std::vector<std::string>> LocalObjectStore::List(ObjectList which) {
  std::vector<std::string> names;
  if (which != ObjectList::kAll) {
    Status listed = AddNames(root_ / (which == ObjectList::kStray ? "stray" : "incoming"), names);
    if (!listed) return std::move(listed.error());
    return names;
  }
  std::error_code failure;
  for (fs::directory_iterator it(root_, failure), end; !failure && it != end;
       it.increment(failure)) {
    if (it->path().filename().string().size() != kFolderDigits) continue;
    Status listed = AddNames(it->path(), names);
    if (!listed) return std::move(listed.error());
  }
  if (failure) return Error{ErrorCode::kIo, "list objects: " + failure.message(), "storage"};
  return names;
}

Result<std::string> LocalObjectStore::ClaimLabel(const std::string& label) {
  const fs::path own = root_ / "temp" / (temp_prefix_ + "label");
  Status written = WriteFile(own, label);
  if (!written) return std::move(written.error());
  const bool claimed = ::link(own.c_str(), LabelFile(root_).c_str()) == 0 || errno == EEXIST;
  const Error failed = StorageError("name the objects' owner");
  ::unlink(own.c_str());
  if (!claimed) return failed;
  Status synced = SyncFolder(root_);
  if (!synced) return std::move(synced.error());
  return Label();
}

// Of a folder that is this process's own, the data directory's probe says as much.
Status LocalObjectStore::CheckWrites() {
  if (sharing_ == Sharing::kOneProcess) return Ok{};
  // In temp, what is left goes after a day.
  return ProbeFolder(root_ / "temp", "-" + temp_prefix_);
}

Status LocalObjectStore::Move(const fs::path& from, const fs::path& to) {
  if (::mkdir(to.parent_path().c_str(), 0700) == 0) {
    Status synced = SyncFolder(root_);
    if (!synced) return synced;
  } else if (errno != EEXIST) {
    return StorageError("make a folder of objects");
  }
  if (::rename(from.c_str(), to.c_str()) != 0) return StorageError("place an object");
  return SyncFolder(to.parent_path());
}

}  // namespace

fs::path LabelFile(const fs::path& root) { return root / "identity"; }

Result<std::string> ReadLabel(const fs::path& root) {
  return ReadFile(LabelFile(root), kLargestLabel);
}

Status WriteLabel(const fs::path& root, const std::string& label) {
  Status written = WriteFile(LabelFile(root), label);
  std::error_code ignored;  // the folder is for its owner alone, too
  fs::permissions(LabelFile(root), fs::perms::owner_read | fs::perms::owner_write, ignored);
  return written;
}

Result<std::unique_ptr<ObjectStore>> OpenLocalObjectStore(const fs::path& root, Sharing sharing) {
  std::error_code failure;
  if (sharing == Sharing::kManyProcesses) {
    RemoveOld(root / "temp");
  } else {
    fs::remove_all(root / "temp", failure);  // files of a process that was killed
  }
  for (const char* folder : {"temp", "incoming", "stray"}) {
    if (!failure) fs::create_directories(root / folder, failure);
  }
  if (failure) {
    return Error{ErrorCode::kIo,
                 "object store: cannot make the folders of " + root.string() + ": " +
                     failure.message() + "; give a data directory that can be written",
                 "storage"};
  }
  // An object is as durable as every folder above it.
  for (const fs::path& folder : {root, root.parent_path()}) {
    Status synced = SyncFolder(folder);
    if (!synced) return std::move(synced.error());
  }
  return std::unique_ptr<ObjectStore>(std::make_unique<LocalObjectStore>(root, sharing));
}

}  // namespace farhorizon
