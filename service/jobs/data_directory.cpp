#include "service/jobs/data_directory.h"

#include <fcntl.h>
#include <string>
#include <sys/file.h>
#include <sys/stat.h>
#include <system_error>
#include <unistd.h>
#include <utility>

#include "service/jobs/storage_file.h"

namespace farhorizon {

namespace {

Error Unusable(const std::filesystem::path& root, const std::string& why) {
  return {ErrorCode::kIo, "data directory " + root.string() + ": " + why, "data-directory"};
}

}  // namespace

Result<DataDirectory> OpenDataDirectory(const std::filesystem::path& path) {
  std::error_code failure;
  const std::filesystem::path root = std::filesystem::absolute(path, failure).lexically_normal();
  std::filesystem::create_directories(root, failure);
  if (failure) {
    return Unusable(root, "cannot be made (" + failure.message() +
                              "); give --data a folder that this user can write");
  }
  struct stat info {};
  if (::stat(root.c_str(), &info) != 0) return Unusable(root, StorageError("stat").message);
  if (info.st_uid != ::geteuid()) {
    return Unusable(root, "belongs to another user (" + std::to_string(info.st_uid) +
                              "); run as that user or change its owner");
  }
  DataDirectory directory{root, UniqueFd(::open((root / "lock").c_str(),
                                                O_RDWR | O_CREAT | O_CLOEXEC | O_NOFOLLOW, 0600))};
  if (!directory.lock) {
    return Unusable(root, StorageError("make the lock file").message +
                              "; give --data a folder that this user can write");
  }
  if (::flock(directory.lock.get(), LOCK_EX | LOCK_NB) != 0) {
    return Unusable(root, "is in use by another farhorizon; stop that one or give another --data");
  }
  for (const auto& folder : {directory.Spool(), directory.Work()}) {
    std::filesystem::remove_all(folder, failure);
    if (!failure) std::filesystem::create_directory(folder, failure);
    if (failure) return Unusable(root, "cannot be cleared: " + failure.message());
    ::chmod(folder.c_str(), 0700);
  }
  return directory;
}

}  // namespace farhorizon
