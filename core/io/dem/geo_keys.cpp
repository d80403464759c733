#include "core/io/dem/geo_keys.h"

#include <cstddef>
#include <vector>

namespace farhorizon {

namespace {

constexpr std::size_t kMaxKeys = 1000;      // GeoTIFF defines some 50
constexpr int kVerticalUnitsGeoKey = 4099;  // OGC 19-008r4, 7.5.1
constexpr int kUserDefined = 32767;

}  // namespace

std::optional<int> ReadGeoKey(TiffFile& tiff, int key) {
  // Rows of four shorts. The first is of the version and the number of keys; another has a key,
  // the tag that has its value, a count, and the value itself where the tag is 0.
  const std::vector<double> rows = tiff.Numbers(0, TiffTag::kGeoKeyDirectory, 4 * (1 + kMaxKeys));
  for (std::size_t at = 4; at + 3 < rows.size(); at += 4) {
    if (rows[at] == key && rows[at + 1] == 0) return static_cast<int>(rows[at + 3]);
  }
  return std::nullopt;
}

std::optional<int> VerticalUnitsKey(TiffFile& tiff) {
  const std::optional<int> code = ReadGeoKey(tiff, kVerticalUnitsGeoKey);
  return code && *code > 0 && *code < kUserDefined ? code : std::nullopt;
}

}  // namespace farhorizon
