#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "service/handlers/archive_format.h"
#include "service/handlers/handler_context.h"
#include "service/handlers/http_message.h"

namespace farhorizon {

/// Files as one archive that is made while it is sent: no copy of it is anywhere, and of the files
/// one is open at a time.
class ArchiveSource : public BodySource {
 public:
  using OpenFile = std::function<Result<std::shared_ptr<BodySource>>(std::size_t index)>;

  /// open: gives the bytes of one of the files.
  ArchiveSource(std::unique_ptr<ArchiveFormat> format, std::vector<ArchiveFile> files,
                OpenFile open);

  [[nodiscard]] std::int64_t bytes() const;
  Result<std::string_view> Read(std::int64_t offset, std::int64_t most) override;

 private:
  /// Opens the file, unless it is the one that is open.
  Status Open(std::size_t index);
  Result<std::uint32_t> SumOf(std::size_t index);
  Result<std::string_view> ReadFile(std::size_t index, std::int64_t offset, std::int64_t most);
  Result<std::string_view> ReadEnd(std::int64_t offset, std::int64_t most);

  std::unique_ptr<ArchiveFormat> format_;
  std::vector<ArchiveFile> files_;
  OpenFile open_;
  std::vector<std::int64_t> starts_;  ///< of each, and the end of the last
  std::vector<std::uint32_t> sums_;
  std::vector<bool> has_sum_;
  std::shared_ptr<BodySource> file_;
  std::size_t file_index_ = 0;
  std::string text_;  ///< what is no file's
  std::string end_;
};

/// All artifacts of a successful job as one zip or tar, with ETag and Range.
/// form: "zip" or "tar".
HttpResponse SendArchive(const HandlerContext& context, const HttpRequest& request, const Job& job,
                         const std::string& form);

}  // namespace farhorizon
