#include "core/io/dem/raster_limits.h"

#include <algorithm>
#include <string>

#include <gdal.h>

namespace farhorizon {

namespace {

constexpr int kMaxSide = 32768;  // Dem's bound

Status CheckSize(GDALRasterBandH band, std::int64_t max_posts) {
  const int columns = GDALGetRasterBandXSize(band);
  const int rows = GDALGetRasterBandYSize(band);
  const std::string size = std::to_string(columns) + " x " + std::to_string(rows);
  if (columns < 2 || rows < 2) {
    return Error{ErrorCode::kUnsupportedData,
                 "the raster has " + size + " cells, at least 2 x 2 are needed", "too-small"};
  }
  if (columns > kMaxSide || rows > kMaxSide || std::int64_t{columns} * rows > max_posts) {
    return Error{ErrorCode::kResourceExhausted,
                 "the raster has " + size + " cells, the limit is " + std::to_string(max_posts) +
                     " and " + std::to_string(kMaxSide) + " a side; cut it or make it coarser",
                 "raster-too-large"};
  }
  return Ok{};
}

// GDAL decodes a block as a whole, some kinds of compression with several copies of it: a few
// hundred bytes of a file can ask for gigabytes. A block much larger than the raster fills memory
// to no purpose, and one of more than kMostInBlock is not what a program for elevations writes:
// whole images in one compressed strip are, up to some 5700 x 5700 posts. (GDAL reads an
// uncompressed one by rows.)
Status CheckBlock(GDALRasterBandH band, std::int64_t max_posts) {
  constexpr std::int64_t kAlwaysFine = std::int64_t{1} << 20;
  constexpr std::int64_t kMostInBlock = std::int64_t{1} << 25;
  int width = 0;
  int height = 0;
  GDALGetBlockSize(band, &width, &height);
  const std::int64_t posts =
      std::int64_t{GDALGetRasterBandXSize(band)} * GDALGetRasterBandYSize(band);
  const std::int64_t limit = std::max(kAlwaysFine, std::min({max_posts, 4 * posts, kMostInBlock}));
  if (width > 0 && height > 0 && std::int64_t{width} * height <= limit) return Ok{};
  return Error{ErrorCode::kResourceExhausted,
               "the raster is stored in blocks of " + std::to_string(width) + " x " +
                   std::to_string(height) + " cells, the limit is " + std::to_string(limit) +
                   "; rewrite it with smaller blocks (gdal_translate -co TILED=YES)",
               "block-too-large"};
}

}  // namespace

Status CheckRasterLimits(void* band, std::int64_t max_posts) {
  Status fits = CheckSize(band, max_posts);
  return fits ? CheckBlock(band, max_posts) : fits;
}

}  // namespace farhorizon
