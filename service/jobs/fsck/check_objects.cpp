#include "service/jobs/fsck/check_objects.h"

#include <string_view>
#include <sys/stat.h>
#include <system_error>

#include "core/io/posix_file.h"
#include "core/io/sha256.h"
#include "service/jobs/object_store.h"
#include "service/jobs/storage_file.h"

namespace farhorizon {

namespace {

namespace fs = std::filesystem;

// The SHA-256 of what can be read of a file.
std::string SumOf(int fd) {
  Sha256 sum;
  std::string piece(std::size_t{1} << 18U, '\0');
  for (;;) {
    const std::int64_t size = ReadSome(fd, piece);
    if (size < 0) return "";
    if (size == 0) return sum.Finish().Hex();
    sum.Add(std::string_view(piece).substr(0, static_cast<std::size_t>(size)));
  }
}

void CheckOne(const fs::path& file, CheckedObjects& into) {
  const std::string name = file.filename().string();
  const Result<UniqueFd> fd = OpenForReading(file);
  struct stat info {};
  if (!fd || ::fstat(fd->get(), &info) != 0) {
    into.unfitting.push_back(file);
  } else if (SumOf(fd->get()) == name) {
    into.good[name] = info.st_size;
  } else {
    into.damaged.push_back(file);
  }
}

}  // namespace

Result<CheckedObjects> CheckObjects(const fs::path& root) {
  CheckedObjects objects;
  std::error_code failure;
  for (fs::directory_iterator folder(root, failure), end; !failure && folder != end;
       folder.increment(failure)) {
    if (folder->path().filename().string().size() != 2) continue;
    for (fs::directory_iterator it(folder->path(), failure); !failure && it != end;
         it.increment(failure)) {
      if (IsSha256(it->path().filename().string())) CheckOne(it->path(), objects);
    }
  }
  if (failure) return Error{ErrorCode::kIo, "list objects: " + failure.message(), "storage"};
  return objects;
}

bool MoveAside(const fs::path& file, const fs::path& aside) {
  std::error_code failure;
  fs::create_directories(aside, failure);
  const std::string name = file.filename().string();
  fs::path target = aside / name;
  for (int copy = 1; fs::exists(target); ++copy)
    target = aside / (name + "." + std::to_string(copy));
  if (!failure) fs::rename(file, target, failure);
  return !failure;
}

}  // namespace farhorizon
