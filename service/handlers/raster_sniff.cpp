#include "service/handlers/raster_sniff.h"

#include <algorithm>
#include <array>
#include <string>

#include "service/handlers/http_message.h"

namespace farhorizon {

namespace {

using namespace std::string_view_literals;

bool StartsWith(std::string_view text, std::string_view beginning) {
  return text.substr(0, beginning.size()) == beginning;
}

bool IsTiff(std::string_view bytes) {
  return StartsWith(bytes, "II\x2a\x00"sv) || StartsWith(bytes, "MM\x00\x2a"sv) ||
         StartsWith(bytes, "II\x2b\x00\x08\x00"sv) || StartsWith(bytes, "MM\x00\x2b\x00\x08"sv);
}

// DTED may have a volume label and a header label, of 80 bytes each, before its user header label.
bool IsDted(std::string_view bytes) {
  constexpr std::size_t kLabelBytes = 80;
  for (int labels = 0; labels < 3; ++labels) {
    if (StartsWith(bytes, "UHL1")) return true;
    if (!StartsWith(bytes, "VOL1") && !StartsWith(bytes, "HDR1")) return false;
    bytes.remove_prefix(std::min(bytes.size(), kLabelBytes));
  }
  return false;
}

bool IsAsciiGrid(std::string_view bytes) {
  constexpr std::array kFirstWords = {"ncols"sv,     "nrows"sv,     "xllcorner"sv,
                                      "yllcorner"sv, "xllcenter"sv, "yllcenter"sv,
                                      "dx"sv,        "dy"sv,        "cellsize"sv};
  const std::size_t start = bytes.find_first_not_of(" \t\r\n");
  if (start == std::string_view::npos) return false;
  const std::size_t end = bytes.find_first_of(" \t", start);
  if (end == std::string_view::npos) return false;
  const std::string word = LowerCase(bytes.substr(start, end - start));
  return std::find(kFirstWords.begin(), kFirstWords.end(), word) != kFirstWords.end();
}

// USGS DEM has no magic number. Like GDAL's driver this reads two numbers of the text header: the
// pattern of elevations at byte 150 and the planimetric reference system at byte 156.
bool IsUsgsDem(std::string_view bytes) {
  if (bytes.size() < 200) return false;
  const std::string_view system = bytes.substr(156, 6);
  const std::string_view pattern = bytes.substr(150, 6);
  return (system == "     0" || system == "     1" || system == "     2" || system == "     3" ||
          system == " -9999") &&
         (pattern == "     1" || pattern == "     4");
}

// Whether GDAL's driver for SRTM HGT takes a file of this name: "N46E007.hgt", or with more text
// before the ending.
bool IsHgtName(std::string_view filename) {
  const std::string name = LowerCase(filename);
  if (name.size() < 11 || name.substr(name.size() - 4) != ".hgt") return false;
  const auto digits = [&](std::size_t from, std::size_t count) {
    return std::all_of(name.begin() + static_cast<std::ptrdiff_t>(from),
                       name.begin() + static_cast<std::ptrdiff_t>(from + count),
                       [](char c) { return c >= '0' && c <= '9'; });
  };
  return (name[0] == 'n' || name[0] == 's') && digits(1, 2) && (name[3] == 'e' || name[3] == 'w') &&
         digits(4, 3);
}

bool IsHgt(std::int64_t bytes, std::string_view filename) {
  constexpr std::array<std::int64_t, 4> kSides = {1201, 3601, 7201, 1801};
  return IsHgtName(filename) && std::any_of(kSides.begin(), kSides.end(), [&](std::int64_t side) {
           return bytes == 2 * side * side || (side == 1801 && bytes == 2 * side * 3601);
         });
}

}  // namespace

bool LooksLikeRaster(std::string_view beginning, std::int64_t bytes, std::string_view filename) {
  return IsTiff(beginning) || IsDted(beginning) || IsAsciiGrid(beginning) || IsUsgsDem(beginning) ||
         IsHgt(bytes, filename);
}

}  // namespace farhorizon
