// Directories of a TIFF, after TIFF 6.0, section 2, and libtiff's BigTIFF: a header that names the
// first one; each has entries of 12 (20) bytes, in which values of up to 4 (8) bytes stand by
// themselves and others by their place, and the place of the next directory.
#include "core/io/dem/tiff/tiff_file.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <utility>

namespace farhorizon {

namespace {

constexpr std::size_t kMaxDirectories = 1000;
// GDAL writes some 30 entries; a directory of more is made to keep a reader busy.
constexpr std::uint64_t kMaxEntries = 1000;
constexpr std::uint64_t kMaxText = 256;

// Bytes of a value of a TIFF type; 0 for types of no number.
std::size_t BytesOf(std::uint16_t type) {
  switch (type) {
    case 1:  // byte
    case 2:  // ASCII
    case 6:  // signed byte
      return 1;
    case 3:  // short
    case 8:  // signed short
      return 2;
    case 4:   // long
    case 9:   // signed long
    case 11:  // float
    case 13:  // IFD
      return 4;
    case 12:  // double
    case 16:  // long8
    case 17:  // signed long8
    case 18:  // IFD8
      return 8;
    default:
      return 0;
  }
}

double AsNumber(std::uint64_t bits, std::uint16_t type) {
  switch (type) {
    case 6:
      return static_cast<std::int8_t>(bits);
    case 8:
      return static_cast<std::int16_t>(bits);
    case 9:
      return static_cast<std::int32_t>(bits);
    case 17:
      return static_cast<double>(static_cast<std::int64_t>(bits));
    case 11:
      return std::bit_cast<float>(static_cast<std::uint32_t>(bits));
    case 12:
      return std::bit_cast<double>(bits);
    default:
      return static_cast<double>(bits);
  }
}

}  // namespace

std::optional<TiffFile> TiffFile::Open(const std::filesystem::path& path) {
  TiffFile tiff;
  tiff.in_.open(path, std::ios::binary);
  std::error_code failure;
  tiff.file_bytes_ = std::filesystem::file_size(path, failure);
  if (!tiff.in_ || failure) return std::nullopt;
  const std::string head = tiff.Bytes(0, 8);
  if (head.size() < 8 || (!head.starts_with("II") && !head.starts_with("MM"))) return std::nullopt;
  tiff.big_endian_ = head[0] == 'M';
  const std::uint64_t version = tiff.Unsigned(head, 2, 2);
  if (version != 42 && version != 43) return std::nullopt;
  tiff.big_tiff_ = version == 43;
  std::uint64_t place = tiff.Unsigned(head, 4, 4);
  if (tiff.big_tiff_) {
    const std::string big = tiff.Bytes(8, 8);
    place = big.empty() ? 0 : tiff.Unsigned(big, 0, 8);
  }
  while (place != 0 && tiff.size() < kMaxDirectories) {
    const std::optional<std::uint64_t> next = tiff.ReadDirectory(place);
    if (!next) break;
    place = *next;
  }
  if (tiff.directories_.empty()) return std::nullopt;
  return tiff;
}

std::string TiffFile::Bytes(std::uint64_t place, std::uint64_t count) {
  if (place > file_bytes_ || count > file_bytes_ - place) return "";
  std::string bytes(count, '\0');
  in_.clear();
  in_.seekg(static_cast<std::streamoff>(place));
  in_.read(bytes.data(), static_cast<std::streamsize>(count));
  return in_ ? bytes : "";
}

std::uint64_t TiffFile::Unsigned(const std::string& bytes, std::size_t at,
                                 std::size_t count) const {
  std::uint64_t value = 0;
  for (std::size_t i = 0; i < count; ++i) {
    const std::size_t byte = big_endian_ ? i : count - 1 - i;
    value = value << 8 | static_cast<unsigned char>(bytes[at + byte]);
  }
  return value;
}

std::optional<std::uint64_t> TiffFile::ReadDirectory(std::uint64_t place) {
  const std::size_t count_bytes = big_tiff_ ? 8 : 2;
  const std::size_t number_bytes = big_tiff_ ? 8 : 4;
  const std::size_t entry_bytes = 4 + 2 * number_bytes;
  const std::string head = Bytes(place, count_bytes);
  if (head.empty()) return std::nullopt;
  const std::uint64_t entries = Unsigned(head, 0, count_bytes);
  if (entries == 0 || entries > kMaxEntries) return std::nullopt;
  const std::uint64_t start = place + count_bytes;
  const std::string body = Bytes(start, entries * entry_bytes + number_bytes);
  if (body.empty()) return std::nullopt;
  Directory directory;
  for (std::uint64_t i = 0; i < entries; ++i) {
    const std::size_t at = i * entry_bytes;
    Entry entry;
    entry.type = static_cast<std::uint16_t>(Unsigned(body, at + 2, 2));
    entry.count = Unsigned(body, at + 4, number_bytes);
    const std::size_t size = BytesOf(entry.type);
    const bool inside = size != 0 && entry.count <= number_bytes / size;
    entry.place = inside ? start + at + 4 + number_bytes
                         : Unsigned(body, at + 4 + number_bytes, number_bytes);
    directory.emplace(static_cast<std::uint16_t>(Unsigned(body, at, 2)), entry);
  }
  directories_.push_back(std::move(directory));
  return Unsigned(body, entries * entry_bytes, number_bytes);
}

const TiffFile::Entry* TiffFile::Find(std::size_t directory, TiffTag tag) const {
  if (directory >= directories_.size()) return nullptr;
  const auto found = directories_[directory].find(static_cast<std::uint16_t>(tag));
  return found == directories_[directory].end() ? nullptr : &found->second;
}

bool TiffFile::Has(std::size_t directory, TiffTag tag) const {
  return Find(directory, tag) != nullptr;
}

std::vector<double> TiffFile::Numbers(std::size_t directory, TiffTag tag, std::size_t at_most) {
  const Entry* entry = Find(directory, tag);
  const std::size_t size = entry != nullptr ? BytesOf(entry->type) : 0;
  if (size == 0) return {};
  const std::string bytes =
      Bytes(entry->place, std::min<std::uint64_t>(entry->count, at_most) * size);
  std::vector<double> numbers;
  numbers.reserve(bytes.size() / size);
  for (std::size_t at = 0; at < bytes.size(); at += size) {
    numbers.push_back(AsNumber(Unsigned(bytes, at, size), entry->type));
  }
  return numbers;
}

std::int64_t TiffFile::Integer(std::size_t directory, TiffTag tag, std::int64_t otherwise) {
  const std::vector<double> numbers = Numbers(directory, tag, 1);
  const bool whole = !numbers.empty() && numbers[0] >= 0 && numbers[0] <= 4294967296.0 &&
                     numbers[0] == std::trunc(numbers[0]);
  return whole ? static_cast<std::int64_t>(numbers[0]) : otherwise;
}

std::optional<int> TiffFile::GeoKey(int key) {
  // Four numbers of a head, then four of each key: key, place (0: right here), count, value.
  constexpr std::size_t kMostNumbers = 4000;
  const std::vector<double> numbers = Numbers(0, TiffTag::kGeoKeyDirectory, kMostNumbers);
  for (std::size_t at = 4; at + 3 < numbers.size(); at += 4) {
    const double value = numbers[at + 3];
    if (numbers[at] != key || numbers[at + 1] != 0) continue;
    if (value >= 0 && value <= 65535) return static_cast<int>(value);
  }
  return std::nullopt;
}

std::string TiffFile::Text(std::size_t directory, TiffTag tag) {
  const Entry* entry = Find(directory, tag);
  if (entry == nullptr || entry->type != 2) return "";
  const std::string bytes = Bytes(entry->place, std::min(entry->count, kMaxText));
  return bytes.substr(0, bytes.find('\0'));
}

std::string TiffFile::WholeText(std::size_t directory, TiffTag tag, std::uint64_t at_most) {
  const Entry* entry = Find(directory, tag);
  if (entry == nullptr || entry->type != 2 || entry->count > at_most) return "";
  return Bytes(entry->place, entry->count);
}

}  // namespace farhorizon
