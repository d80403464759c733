#include "service/worker/folder_bytes.h"

#include <algorithm>
#include <sys/stat.h>
#include <system_error>

namespace farhorizon {

namespace {

// An honest worker writes some thirty files. So many small ones that counting them takes long are
// too many, whatever little room they take.
constexpr std::int64_t kLeastOfEntry = std::int64_t{1} << 16U;
constexpr std::int64_t kStatBlock = 512;  // of st_blocks, whatever the file system's are

}  // namespace

std::int64_t BytesIn(const std::filesystem::path& folder, std::int64_t most) {
  namespace fs = std::filesystem;
  std::int64_t bytes = 0;
  std::error_code failure;
  fs::recursive_directory_iterator at(folder, fs::directory_options::skip_permission_denied,
                                      failure);
  while (!failure && at != fs::recursive_directory_iterator() && bytes <= most) {
    struct stat about {};
    if (::lstat(at->path().c_str(), &about) == 0) {
      bytes += std::max<std::int64_t>(kLeastOfEntry, about.st_blocks * kStatBlock);
    }
    at.increment(failure);
  }
  return bytes;
}

}  // namespace farhorizon
