#include "service/handlers/zip_format.h"

#include <algorithm>
#include <chrono>

namespace farhorizon {

namespace {

// What a field of 32 or 16 bits says where the true value stands in a field of zip64.
constexpr std::int64_t kLarge = 0xffffffff;
constexpr std::size_t kMany = 0xffff;

// The numbers of a zip have the lowest byte first.
void Add(std::string& text, std::uint64_t value, int bytes) {
  for (int i = 0; i < bytes; ++i, value >>= 8U) text += static_cast<char>(value & 255U);
}
void Add16(std::string& text, std::uint64_t value) { Add(text, value, 2); }
void Add32(std::string& text, std::uint64_t value) { Add(text, value, 4); }
void Add64(std::string& text, std::int64_t value) {
  Add(text, static_cast<std::uint64_t>(value), 8);
}
std::uint64_t Capped(std::int64_t value) {
  return static_cast<std::uint64_t>(std::min(value, kLarge));
}

// MS-DOS knows years from 1980 on, and every other second.
std::uint32_t DosTime(std::int64_t time_ms) {
  using namespace std::chrono;
  const sys_seconds time{seconds(time_ms / 1000)};
  const auto day = floor<days>(time);
  const year_month_day date(day);
  const hh_mm_ss clock(time - day);
  const int year = std::max(static_cast<int>(date.year()), 1980) - 1980;
  const auto ymd = static_cast<std::uint32_t>(year) << 9U |
                   static_cast<unsigned>(date.month()) << 5U | static_cast<unsigned>(date.day());
  const auto hms = static_cast<std::uint32_t>(clock.hours().count()) << 11U |
                   static_cast<std::uint32_t>(clock.minutes().count()) << 5U |
                   static_cast<std::uint32_t>(clock.seconds().count()) / 2;
  return ymd << 16U | hms;
}

// What an entry says of a file in zip64's field; empty: nothing needs it.
std::string LargeNumbers(const ArchiveFile& file, std::int64_t start) {
  std::string numbers;
  if (file.bytes >= kLarge) {
    Add64(numbers, file.bytes);
    Add64(numbers, file.bytes);
  }
  if (start >= kLarge) Add64(numbers, start);
  if (numbers.empty()) return numbers;
  std::string field;
  Add16(field, 1);
  Add16(field, numbers.size());
  return field + numbers;
}

std::int64_t SizeOf(const std::string& text) { return static_cast<std::int64_t>(text.size()); }

struct Directory {
  std::int64_t start = 0;
  std::int64_t bytes = 0;
  std::size_t files = 0;

  [[nodiscard]] bool NeedsZip64() const {
    return files >= kMany || start >= kLarge || bytes >= kLarge;
  }
};

constexpr std::int64_t kEntryBytes = 46;
constexpr std::int64_t kEndBytes = 22;
constexpr std::int64_t kZip64EndBytes = 56 + 20;

Directory DirectoryOf(const std::vector<ArchiveFile>& files,
                      const std::vector<std::int64_t>& starts) {
  Directory directory{starts.back(), 0, files.size()};
  for (std::size_t i = 0; i < files.size(); ++i) {
    directory.bytes +=
        kEntryBytes + SizeOf(files[i].name) + SizeOf(LargeNumbers(files[i], starts[i]));
  }
  return directory;
}

void AddEnd(std::string& text, const Directory& directory) {
  if (directory.NeedsZip64()) {
    const std::int64_t at = directory.start + directory.bytes;
    Add32(text, 0x06064b50);
    Add64(text, 44);  // bytes of the record that follow
    Add16(text, 3U << 8U | 45U);
    Add16(text, 45);
    Add32(text, 0);
    Add32(text, 0);
    Add64(text, static_cast<std::int64_t>(directory.files));
    Add64(text, static_cast<std::int64_t>(directory.files));
    Add64(text, directory.bytes);
    Add64(text, directory.start);
    Add32(text, 0x07064b50);
    Add32(text, 0);
    Add64(text, at);
    Add32(text, 1);
  }
  Add32(text, 0x06054b50);
  Add32(text, 0);
  Add16(text, std::min(directory.files, kMany));
  Add16(text, std::min(directory.files, kMany));
  Add32(text, Capped(directory.bytes));
  Add32(text, Capped(directory.start));
  Add16(text, 0);
}

}  // namespace

ZipFormat::ZipFormat(std::int64_t time_ms) : dos_time_(DosTime(time_ms)) {}

std::int64_t ZipFormat::HeadBytes(const ArchiveFile& file) const {
  return 30 + SizeOf(file.name) + SizeOf(LargeNumbers(file, 0));
}

void ZipFormat::AddCommon(std::string& text, const ArchiveFile& file, std::uint32_t sum,
                          bool zip64) const {
  Add16(text, zip64 ? 45 : 20);  // the version that reads it
  Add16(text, 0);
  Add16(text, 0);  // stored
  Add32(text, dos_time_);
  Add32(text, sum);
  Add32(text, Capped(file.bytes));
  Add32(text, Capped(file.bytes));
  Add16(text, file.name.size());
}

std::string ZipFormat::Head(const ArchiveFile& file, std::uint32_t sum) const {
  const std::string large = LargeNumbers(file, 0);
  std::string head;
  Add32(head, 0x04034b50);
  AddCommon(head, file, sum, !large.empty());
  Add16(head, large.size());
  return head + file.name + large;
}

std::int64_t ZipFormat::PaddingBytes(const ArchiveFile& /*file*/) const { return 0; }

std::int64_t ZipFormat::EndBytes(const std::vector<ArchiveFile>& files,
                                 const std::vector<std::int64_t>& starts) const {
  const Directory directory = DirectoryOf(files, starts);
  return directory.bytes + kEndBytes + (directory.NeedsZip64() ? kZip64EndBytes : 0);
}

std::string ZipFormat::End(const std::vector<ArchiveFile>& files,
                           const std::vector<std::int64_t>& starts,
                           const std::vector<std::uint32_t>& sums) const {
  std::string text;
  for (std::size_t i = 0; i < files.size(); ++i) {
    const std::string large = LargeNumbers(files[i], starts[i]);
    Add32(text, 0x02014b50);
    Add16(text, 3U << 8U | 45U);  // made by Unix
    AddCommon(text, files[i], sums[i], !large.empty());
    Add16(text, large.size());
    Add16(text, 0);
    Add16(text, 0);
    Add16(text, 0);
    Add32(text, 0100644U << 16U);
    Add32(text, Capped(starts[i]));
    text += files[i].name + large;
  }
  AddEnd(text, DirectoryOf(files, starts));
  return text;
}

}  // namespace farhorizon
