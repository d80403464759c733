// Masks are read a few rows at a time: they cost no memory beside the heights.
#include "core/io/dem/band_mask.h"

#include <algorithm>
#include <cstdint>
#include <functional>
#include <limits>
#include <string>

#include <gdal.h>

#include "core/io/dem/complete_raster.h"
#include "core/io/file.h"
#include "core/io/raster/open_raster.h"

namespace farhorizon {

namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

// Calls `take` with each post and its value in `mask`.
Status ForEachCell(GDALRasterBandH mask, GdalSession& session,
                   const std::function<void(std::size_t post, double value)>& take) {
  constexpr int kCellsAtOnce = 1 << 18;
  const int columns = GDALGetRasterBandXSize(mask);
  const int rows = GDALGetRasterBandYSize(mask);
  const int rows_at_once = std::max(1, kCellsAtOnce / columns);
  std::vector<double> cells;
  std::size_t post = 0;
  for (int row = 0; row < rows; row += rows_at_once) {
    const int count = std::min(rows_at_once, rows - row);
    cells.resize(static_cast<std::size_t>(count) * static_cast<std::size_t>(columns));
    if (GDALRasterIO(mask, GF_Read, 0, row, columns, count, cells.data(), columns, count,
                     GDT_Float64, 0, 0) != CE_None ||
        session.Failed()) {
      return Truncated("its mask cannot be read" + session.Complaint());
    }
    for (const double cell : cells) take(post++, cell);
  }
  return Ok{};
}

Status ApplyMask(GDALRasterBandH mask, GdalSession& session, std::vector<double>& values) {
  return ForEachCell(mask, session, [&](std::size_t post, double shown) {
    if (!(shown > 0)) values[post] = kNan;
  });
}

Status ApplyAlpha(GDALRasterBandH alpha, GdalSession& session, std::vector<double>& values,
                  Assumptions& assumptions) {
  double opaque = 0;
  double least = std::numeric_limits<double>::infinity();
  Status read = ForEachCell(alpha, session, [&](std::size_t post, double shown) {
    if (!(shown > 0)) {
      values[post] = kNan;
      return;
    }
    opaque = std::max(opaque, shown);
    least = std::min(least, shown);
  });
  if (read && least < opaque) {
    assumptions.push_back(
        {"alpha-in-part",
         "the alpha band shows some posts in part; only those where it is 0 were left out as no "
         "data; for another limit make nodata of them, as with gdal_calc.py -A IN --A_band=1 -B "
         "IN --B_band=2 --outfile=OUT --NoDataValue=-9999 --calc=\"where(B<255,-9999,A)\""});
  }
  return read;
}

Status ApplyMaskFile(GDALRasterBandH heights, const std::filesystem::path& path,
                     GdalSession& session, std::vector<double>& values, Assumptions& assumptions) {
  std::filesystem::path beside = path;
  beside += ".msk";
  std::error_code failure;
  if (!std::filesystem::is_regular_file(beside, failure)) return Ok{};
  const char* const drivers[] = {"GTiff", nullptr};
  const char* const options[] = {"OVERVIEW_LEVEL=NONE", "GEOREF_SOURCES=NONE", nullptr};
  const RasterPtr mask(GDALOpenEx(AbsolutePath(beside).c_str(), GDAL_OF_RASTER | GDAL_OF_READONLY,
                                  drivers, options, nullptr));
  const bool fits = mask && GDALGetRasterCount(mask.get()) >= 1 &&
                    GDALGetRasterXSize(mask.get()) == GDALGetRasterBandXSize(heights) &&
                    GDALGetRasterYSize(mask.get()) == GDALGetRasterBandYSize(heights);
  session.Forget();
  if (fits) return ApplyMask(GDALGetRasterBand(mask.get(), 1), session, values);
  assumptions.push_back(
      {"mask-file", "the file " + beside.filename().string() +
                        " beside, by its name a mask, was passed over: it is no TIFF of the same "
                        "size; take it away, or make the mask again"});
  return Ok{};
}

}  // namespace

Status ApplyMasks(const HeightBand& band, const std::filesystem::path& path, GdalSession& session,
                  std::vector<double>& values, Assumptions& assumptions) {
  if (band.alpha != nullptr) {
    Status shown = ApplyAlpha(band.alpha, session, values, assumptions);
    if (!shown) return shown;
  } else if ((GDALGetMaskFlags(band.heights) & GMF_PER_DATASET) != 0) {
    Status shown = ApplyMask(GDALGetMaskBand(band.heights), session, values);
    if (!shown) return shown;
  }
  return ApplyMaskFile(band.heights, path, session, values, assumptions);
}

void HidePlaces(const std::vector<PostRectangle>& places, int columns,
                std::vector<double>& values) {
  for (const PostRectangle& place : places) {
    for (std::int64_t row = place.first_row; row < place.end_row; ++row) {
      const auto start = values.begin() + row * columns;
      std::fill(start + place.first_column, start + place.end_column, kNan);
    }
  }
}

}  // namespace farhorizon
