#pragma once

#include "service/handlers/archive_format.h"

namespace farhorizon {

/// zip as [APPNOTE] has it: files are stored, their sizes and sums stand before their bytes, so
/// that readers of streams need no end. Zip64 where a file, a place or the number of files asks for
/// it.
class ZipFormat : public ArchiveFormat {
 public:
  /// time_ms: when all files were made, milliseconds since 1970; said in UTC.
  explicit ZipFormat(std::int64_t time_ms);

  [[nodiscard]] bool NeedsSums() const override { return true; }
  [[nodiscard]] std::int64_t HeadBytes(const ArchiveFile& file) const override;
  [[nodiscard]] std::string Head(const ArchiveFile& file, std::uint32_t sum) const override;
  [[nodiscard]] std::int64_t PaddingBytes(const ArchiveFile& file) const override;
  [[nodiscard]] std::int64_t EndBytes(const std::vector<ArchiveFile>& files,
                                      const std::vector<std::int64_t>& starts) const override;
  [[nodiscard]] std::string End(const std::vector<ArchiveFile>& files,
                                const std::vector<std::int64_t>& starts,
                                const std::vector<std::uint32_t>& sums) const override;

 private:
  /// What an entry of the directory, and a head, say of a file, from its version on.
  void AddCommon(std::string& text, const ArchiveFile& file, std::uint32_t sum, bool zip64) const;

  std::uint32_t dos_time_ = 0;  ///< the date in the upper half
};

}  // namespace farhorizon
