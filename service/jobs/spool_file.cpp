#include "service/jobs/spool_file.h"

#include <atomic>
#include <fcntl.h>
#include <unistd.h>

#include "core/io/posix_file.h"
#include "service/jobs/storage_file.h"

namespace farhorizon {

namespace {

constexpr std::size_t kBeginningBytes = 4096;

}  // namespace

Result<SpoolFile> SpoolFile::Create(const std::filesystem::path& directory) {
  static std::atomic<std::int64_t> next{0};
  const std::filesystem::path path = directory / ("upload-" + std::to_string(next++));
  UniqueFd fd(::open(path.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC | O_NOFOLLOW, 0600));
  if (!fd) return StorageError("make a spool file");
  return SpoolFile(path, std::move(fd));
}

SpoolFile::~SpoolFile() {
  if (fd_) ::unlink(path_.c_str());
}

Status SpoolFile::Write(std::string_view bytes) {
  if (!WriteAll(fd_.get(), bytes)) return StorageError("write");
  if (beginning_.size() < kBeginningBytes) {
    beginning_ += bytes.substr(0, kBeginningBytes - beginning_.size());
  }
  bytes_ += static_cast<std::int64_t>(bytes.size());
  return Ok{};
}

}  // namespace farhorizon
