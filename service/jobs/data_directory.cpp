#include "service/jobs/data_directory.h"

#include <fcntl.h>
#include <string>
#include <sys/file.h>
#include <sys/stat.h>
#include <system_error>
#include <unistd.h>
#include <utility>

#include "core/io/file.h"
#include "service/jobs/end_mark.h"
#include "service/jobs/storage_file.h"

namespace farhorizon {

namespace {

namespace fs = std::filesystem;

constexpr mode_t kWritableByOthers = S_IWGRP | S_IWOTH;
constexpr mode_t kForOthers = S_IRWXG | S_IRWXO;

Error Unusable(const fs::path& root, const std::string& why) {
  return {ErrorCode::kIo, "data directory " + root.string() + ": " + why, "data-directory"};
}

// What the owner alone may reach: the folder `root`, or something in it.
Status CheckPrivate(const fs::path& root, const fs::path& path) {
  struct stat info {};
  const bool is_root = path == root;
  const std::string what = is_root ? "it" : path.lexically_relative(root).string();
  // The folder itself may be reached by a link.
  const int looked = is_root ? ::stat(path.c_str(), &info) : ::lstat(path.c_str(), &info);
  if (looked != 0) return Unusable(root, StorageError("stat").message);
  if (S_ISLNK(info.st_mode)) {
    return Unusable(root, what +
                              " is a link, which could lead anywhere; put the file or folder "
                              "itself in its place");
  }
  if (info.st_uid != ::geteuid()) {
    return Unusable(root, what + " belongs to another user (" + std::to_string(info.st_uid) +
                              "); run as that user, or: chown -R " + std::to_string(::geteuid()) +
                              " " + root.string());
  }
  if ((info.st_mode & kWritableByOthers) != 0) {
    return Unusable(root, what +
                              " can be written by other users; see what they wrote, then: "
                              "chmod -R go-rwx " +
                              root.string());
  }
  if ((info.st_mode & kForOthers) == 0) return Ok{};
  if (::chmod(path.c_str(), info.st_mode & 07777 & ~kForOthers) == 0) return Ok{};
  return Unusable(root, what + " can be read by other users, and " + StorageError("chmod").message +
                            "; chmod -R go-rwx " + root.string());
}

Status CheckEntries(const fs::path& root, const fs::path& folder) {
  std::error_code failure;
  for (fs::directory_iterator it(folder, failure), end; !failure && it != end;
       it.increment(failure)) {
    Status checked = CheckPrivate(root, it->path());
    if (!checked) return checked;
  }
  if (failure) return Unusable(root, "cannot be read: " + failure.message());
  return Ok{};
}

Status CheckAllPrivate(const fs::path& root) {
  Status checked = CheckPrivate(root, root);
  if (checked) checked = CheckEntries(root, root);
  std::error_code none;
  if (checked && fs::exists(root / "objects", none)) checked = CheckEntries(root, root / "objects");
  return checked;
}

bool SameFile(int fd, const fs::path& path) {
  struct stat held {};
  struct stat named {};
  return ::fstat(fd, &held) == 0 && ::stat(path.c_str(), &named) == 0 &&
         held.st_dev == named.st_dev && held.st_ino == named.st_ino && held.st_nlink > 0;
}

Result<DataDirectory> Lock(const fs::path& root) {
  Status checked = CheckAllPrivate(root);
  if (!checked) return std::move(checked.error());
  DataDirectory directory{
      root, UniqueFd(::open(root.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC)),
      UniqueFd(::open((root / "lock").c_str(), O_RDWR | O_CREAT | O_CLOEXEC | O_NOFOLLOW, 0600))};
  if (!directory.folder || !directory.lock) {
    return Unusable(root, StorageError("make the lock file").message +
                              "; give --data a folder that this user can write");
  }
  // Both: earlier versions know the file alone, and the file may be removed or replaced.
  for (const int fd : {directory.folder.get(), directory.lock.get()}) {
    if (::flock(fd, LOCK_EX | LOCK_NB) == 0) continue;
    return Unusable(root, "is in use by another farhorizon; stop that one or give another --data");
  }
  directory.previous_end = ReadEndMark(directory.lock.get());
  return directory;
}

}  // namespace

Status DataDirectory::CheckHeld() const {
  if (SameFile(lock.get(), root / "lock") && SameFile(folder.get(), root)) return Ok{};
  return Unusable(root,
                  "it or its lock file was removed or replaced while the service ran; "
                  "restart the service");
}

Result<DataDirectory> LockDataDirectory(const fs::path& path) {
  const fs::path root = AbsolutePath(path);
  std::error_code none;
  if (!fs::is_directory(root, none)) return Unusable(root, "there is no such folder");
  return Lock(root);
}

Result<DataDirectory> OpenDataDirectory(const fs::path& path) {
  const fs::path root = AbsolutePath(path);
  std::error_code failure;
  const bool made = fs::create_directories(root, failure);
  if (made) ::chmod(root.c_str(), 0700);
  if (failure) {
    return Unusable(root, "cannot be made (" + failure.message() +
                              "); give --data a folder that this user can write");
  }
  if (made) {
    Status synced = SyncFolder(root.parent_path());
    if (!synced) return std::move(synced.error());
  }
  Result<DataDirectory> directory = Lock(root);
  if (!directory) return directory;
  for (const auto& folder : {directory->Spool(), directory->Work()}) {
    fs::remove_all(folder, failure);
    if (!failure) fs::create_directory(folder, failure);
    if (failure) return Unusable(root, "cannot be cleared: " + failure.message());
    ::chmod(folder.c_str(), 0700);
  }
  return directory;
}

}  // namespace farhorizon
