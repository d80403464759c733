#include "service/jobs/fsck/check_objects.h"

#include <string_view>
#include <sys/stat.h>
#include <system_error>

#include "core/io/sha256.h"
#include "service/jobs/object_store.h"
#include "service/jobs/storage_file.h"

namespace farhorizon {

namespace {

namespace fs = std::filesystem;

// The SHA-256 of a file; empty where it cannot be read.
std::string SumOf(int fd) {
  Sha256 sum;
  const Status read = ForEachPiece(fd, "read an object", [&sum](std::string_view piece) -> Status {
    sum.Add(piece);
    return Ok{};
  });
  return read ? sum.Finish().Hex() : "";
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
