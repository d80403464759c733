#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>

#include "core/base/result.h"
#include "core/io/unique_fd.h"

namespace farhorizon {

/// A private file for the bytes of an upload; removed with this object.
class SpoolFile {
 public:
  /// Makes a new file in `directory`. Errors: kIo, kResourceExhausted "no-space".
  static Result<SpoolFile> Create(const std::filesystem::path& directory);

  SpoolFile(SpoolFile&&) noexcept = default;
  SpoolFile& operator=(SpoolFile&&) noexcept = delete;
  ~SpoolFile();

  /// Appends `bytes`. Errors: as Create.
  Status Write(std::string_view bytes);
  [[nodiscard]] const std::filesystem::path& path() const { return path_; }
  /// For those who write without Write; bytes() and beginning() do not count that.
  [[nodiscard]] int fd() const { return fd_.get(); }
  [[nodiscard]] std::int64_t bytes() const { return bytes_; }
  /// The first bytes, at most 4096: enough to recognise a raster format.
  [[nodiscard]] const std::string& beginning() const { return beginning_; }

 private:
  SpoolFile(std::filesystem::path path, UniqueFd fd) : path_(std::move(path)), fd_(std::move(fd)) {}

  std::filesystem::path path_;
  UniqueFd fd_;
  std::int64_t bytes_ = 0;
  std::string beginning_;
};

}  // namespace farhorizon
