#include "service/handlers/tar_format.h"

#include <numeric>
#include <string_view>

namespace farhorizon {

namespace {

constexpr std::int64_t kBlock = 512;
constexpr std::size_t kSumAt = 148;

// `value` as octal digits, a NUL after them.
std::string Octal(std::int64_t value, std::size_t digits) {
  std::string text(digits + 1, '\0');
  for (std::size_t i = digits; i-- > 0; value /= 8) text[i] = static_cast<char>('0' + value % 8);
  return text;
}

// Eleven octal digits; what has more as a binary number whose first bit is set.
std::string Size(std::int64_t value) {
  if (value < std::int64_t{1} << 33U) return Octal(value, 11);
  std::string text(12, '\0');
  for (std::size_t i = text.size(); i-- > 0; value >>= 8U) text[i] = static_cast<char>(value & 255);
  text[0] = static_cast<char>(0x80);
  return text;
}

}  // namespace

std::int64_t TarFormat::HeadBytes(const ArchiveFile& /*file*/) const { return kBlock; }

std::string TarFormat::Head(const ArchiveFile& file, std::uint32_t /*sum*/) const {
  std::string head(kBlock, '\0');
  const auto put = [&head](std::size_t at, std::string_view text) {
    head.replace(at, text.size(), text);
  };
  put(0, file.name);
  put(100, Octal(0644, 7));
  put(108, Octal(0, 7));
  put(116, Octal(0, 7));
  put(124, Size(file.bytes));
  put(136, Octal(seconds_, 11));
  put(kSumAt, "        ");  // counted as blanks
  put(156, "0");
  put(257, std::string_view("ustar\00000", 8));
  const std::int64_t sum = std::accumulate(
      head.begin(), head.end(), std::int64_t{0},
      [](std::int64_t so_far, char c) { return so_far + static_cast<unsigned char>(c); });
  put(kSumAt, Octal(sum, 6) + " ");
  return head;
}

std::int64_t TarFormat::PaddingBytes(const ArchiveFile& file) const {
  return (kBlock - file.bytes % kBlock) % kBlock;
}

std::int64_t TarFormat::EndBytes(const std::vector<ArchiveFile>& /*files*/,
                                 const std::vector<std::int64_t>& /*starts*/) const {
  return 2 * kBlock;
}

std::string TarFormat::End(const std::vector<ArchiveFile>& files,
                           const std::vector<std::int64_t>& starts,
                           const std::vector<std::uint32_t>& /*sums*/) const {
  std::string zeros;
  zeros.resize(static_cast<std::size_t>(EndBytes(files, starts)), '\0');
  return zeros;
}

}  // namespace farhorizon
