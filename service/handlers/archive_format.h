#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace farhorizon {

/// One file of an archive.
struct ArchiveFile {
  std::string name;  ///< at most 100 ASCII characters, no folder
  std::int64_t bytes = 0;
};

/// How an archive lays out files that it does not compress. All lengths follow from names and
/// sizes, so that an archive is as long as is known beforehand, and any part of it can be made.
class ArchiveFormat {
 public:
  ArchiveFormat() = default;
  virtual ~ArchiveFormat() = default;
  ArchiveFormat(const ArchiveFormat&) = delete;
  ArchiveFormat& operator=(const ArchiveFormat&) = delete;

  /// Whether Head and End need CRC-32s. Where they do not, they get zeros.
  [[nodiscard]] virtual bool NeedsSums() const = 0;

  /// What stands before the bytes of `file`, and how long it is.
  [[nodiscard]] virtual std::int64_t HeadBytes(const ArchiveFile& file) const = 0;
  [[nodiscard]] virtual std::string Head(const ArchiveFile& file, std::uint32_t sum) const = 0;
  /// How many zeros stand after them.
  [[nodiscard]] virtual std::int64_t PaddingBytes(const ArchiveFile& file) const = 0;

  /// What stands after all files. starts: where the head of each begins, and where the last ends.
  [[nodiscard]] virtual std::int64_t EndBytes(const std::vector<ArchiveFile>& files,
                                              const std::vector<std::int64_t>& starts) const = 0;
  [[nodiscard]] virtual std::string End(const std::vector<ArchiveFile>& files,
                                        const std::vector<std::int64_t>& starts,
                                        const std::vector<std::uint32_t>& sums) const = 0;
};

}  // namespace farhorizon
