#pragma once

#include "service/handlers/archive_format.h"

namespace farhorizon {

/// tar as POSIX.1-1988 has it (ustar); sizes from 8 GiB on in GNU's binary form.
class TarFormat : public ArchiveFormat {
 public:
  /// time_ms: when all files were made, milliseconds since 1970.
  explicit TarFormat(std::int64_t time_ms) : seconds_(time_ms / 1000) {}

  [[nodiscard]] bool NeedsSums() const override { return false; }
  [[nodiscard]] std::int64_t HeadBytes(const ArchiveFile& file) const override;
  [[nodiscard]] std::string Head(const ArchiveFile& file, std::uint32_t sum) const override;
  [[nodiscard]] std::int64_t PaddingBytes(const ArchiveFile& file) const override;
  [[nodiscard]] std::int64_t EndBytes(const std::vector<ArchiveFile>& files,
                                      const std::vector<std::int64_t>& starts) const override;
  [[nodiscard]] std::string End(const std::vector<ArchiveFile>& files,
                                const std::vector<std::int64_t>& starts,
                                const std::vector<std::uint32_t>& sums) const override;

 private:
  std::int64_t seconds_;
};

}  // namespace farhorizon
