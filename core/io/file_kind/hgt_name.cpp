#include "core/io/file_kind/hgt_name.h"

#include <algorithm>
#include <array>

namespace farhorizon {

namespace {

// In ascending order.
constexpr std::array<std::int64_t, 5> kTileBytes = {
    2LL * 1201 * 1201, 2LL * 1801 * 1801, 2LL * 1801 * 3601, 2LL * 3601 * 3601, 2LL * 7201 * 7201};

char Lower(char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; }

bool IsDigit(char c) { return c >= '0' && c <= '9'; }

// "n46e007" at the beginning of `name`.
bool BeginsWithCorner(std::string_view name) {
  if (name.size() < 7) return false;
  const char latitude = Lower(name[0]);
  const char longitude = Lower(name[3]);
  return (latitude == 'n' || latitude == 's') && (longitude == 'e' || longitude == 'w') &&
         IsDigit(name[1]) && IsDigit(name[2]) && IsDigit(name[4]) && IsDigit(name[5]) &&
         IsDigit(name[6]);
}

}  // namespace

bool HasEnding(std::string_view filename, std::string_view ending) {
  return filename.size() >= ending.size() &&
         std::equal(ending.rbegin(), ending.rend(), filename.rbegin(),
                    [](char a, char b) { return a == Lower(b); });
}

bool IsHgtName(std::string_view filename) {
  return BeginsWithCorner(filename) && filename.size() >= 11 && filename[7] == '.' &&
         HasEnding(filename, ".hgt");
}

bool IsHgtSize(std::int64_t bytes) {
  return std::ranges::find(kTileBytes, bytes) != kTileBytes.end();
}

std::optional<Error> HgtFault(std::string_view filename, std::int64_t bytes) {
  if (!IsHgtName(filename)) {
    std::string like = "N46E007.hgt";
    if (BeginsWithCorner(filename)) like = std::string(filename.substr(0, 7)) + ".hgt";
    return Error{ErrorCode::kUnsupportedData,
                 "an HGT file is known by its name, which is all that says where it lies: the "
                 "degrees of its south-western corner and .hgt, such as " +
                     like + "; give it that name",
                 "not-a-raster"};
  }
  if (IsHgtSize(bytes)) return std::nullopt;
  const auto* whole = std::ranges::find_if(kTileBytes, [&](auto size) { return size > bytes; });
  std::string sizes;
  for (const std::int64_t size : kTileBytes) {
    sizes += (sizes.empty()               ? ""
              : size == kTileBytes.back() ? " or "
                                          : ", ") +
             std::to_string(size);
  }
  const std::string cut = whole != kTileBytes.end() && bytes > 0
                              ? ", it may be cut short (" + std::to_string(bytes) + " of " +
                                    std::to_string(*whole) + " bytes)"
                              : "";
  return Error{ErrorCode::kUnsupportedData,
               "the raster is not complete: an HGT file has " + sizes + " bytes, this one has " +
                   std::to_string(bytes) + cut + "; fetch it again",
               "truncated"};
}

}  // namespace farhorizon
