// Reads a DEM through GDAL without trusting the file: all that can be refused from the header is
// refused before the first pixel is read. GdalSession keeps GDAL from opening other files.
#include "core/io/dem/read_dem.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include <gdal.h>

#include "core/io/dem/complete_raster.h"
#include "core/io/dem/height_quantum.h"
#include "core/io/dem/nodata_rule.h"
#include "core/io/dem/raster_place.h"
#include "core/io/dem/value_scale.h"
#include "core/io/gdal_session.h"
#include "core/io/raster/open_raster.h"

namespace farhorizon {

namespace {

constexpr int kMaxSide = 32768;  // Dem's bound

Error BadData(const std::string& message, ErrorKind kind) {
  return {ErrorCode::kUnsupportedData, message, kind};
}

Status CheckSize(GDALDatasetH dataset, const DemReadOptions& options) {
  const int columns = GDALGetRasterXSize(dataset);
  const int rows = GDALGetRasterYSize(dataset);
  const std::string size = std::to_string(columns) + " x " + std::to_string(rows);
  const int bands = GDALGetRasterCount(dataset);
  if (bands != 1) {
    return BadData("the raster has " + std::to_string(bands) +
                       " bands, expected 1; take out the one with the heights "
                       "(gdal_translate -b)",
                   bands == 0 ? ErrorKind("not-a-raster") : "several-bands");
  }
  if (columns < 2 || rows < 2) {
    return BadData("the raster has " + size + " cells, at least 2 x 2 are needed", "too-small");
  }
  if (columns > kMaxSide || rows > kMaxSide || std::int64_t{columns} * rows > options.max_posts) {
    return Error{ErrorCode::kResourceExhausted,
                 "the raster has " + size + " cells, the limit is " +
                     std::to_string(options.max_posts) + " and " + std::to_string(kMaxSide) +
                     " a side; cut it or make it coarser",
                 "raster-too-large"};
  }
  return Ok{};
}

// GDAL decodes a block as a whole. A block much larger than the raster fills memory to no purpose.
Status CheckBlock(GDALRasterBandH band, const DemReadOptions& options) {
  constexpr std::int64_t kAlwaysFine = std::int64_t{1} << 20;
  int width = 0;
  int height = 0;
  GDALGetBlockSize(band, &width, &height);
  const std::int64_t posts =
      std::int64_t{GDALGetRasterBandXSize(band)} * GDALGetRasterBandYSize(band);
  const std::int64_t limit = std::max(kAlwaysFine, std::min(options.max_posts, 4 * posts));
  if (width > 0 && height > 0 && std::int64_t{width} * height <= limit) return Ok{};
  return Error{ErrorCode::kResourceExhausted,
               "the raster is stored in blocks of " + std::to_string(width) + " x " +
                   std::to_string(height) + " cells, the limit is " + std::to_string(limit) +
                   "; rewrite it with smaller blocks (gdal_translate -co TILED=YES)",
               "block-too-large"};
}

Status CheckType(GDALRasterBandH band) {
  const GDALDataType type = GDALGetRasterDataType(band);
  if (GDALDataTypeIsComplex(type) != 0 || type == GDT_Unknown) {
    return BadData(std::string("the band's values are of type ") + GDALGetDataTypeName(type) +
                       ", heights must be real numbers",
                   "unsupported-type");
  }
  if (GDALGetRasterColorTable(band) != nullptr) {
    return BadData("the band is a picture with a colour table, heights are needed",
                   "unsupported-type");
  }
  return Ok{};
}

// Makes NaN of cells that an internal mask hides, whatever their values.
Status ApplyMask(GDALRasterBandH band, GdalSession& session, std::vector<double>& values) {
  if ((GDALGetMaskFlags(band) & GMF_PER_DATASET) == 0) return Ok{};
  const int columns = GDALGetRasterBandXSize(band);
  const int rows = GDALGetRasterBandYSize(band);
  std::vector<std::uint8_t> mask(values.size());
  if (GDALRasterIO(GDALGetMaskBand(band), GF_Read, 0, 0, columns, rows, mask.data(), columns, rows,
                   GDT_Byte, 0, 0) != CE_None ||
      session.Failed()) {
    return Truncated("its mask cannot be read" + session.Complaint());
  }
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (mask[i] == 0) values[i] = std::numeric_limits<double>::quiet_NaN();
  }
  return Ok{};
}

std::string CellName(std::size_t post, int columns) {
  const auto width = static_cast<std::size_t>(columns);
  return "the cell at column " + std::to_string(post % width) + ", row " +
         std::to_string(post / width);
}

// The band's raw values, rows x columns, NaN where there is no data. All others pass as heights.
Result<std::vector<double>> ReadValues(GDALRasterBandH band, const NoDataRule& nodata,
                                       const ValueScale& scale, GdalSession& session) {
  const int columns = GDALGetRasterBandXSize(band);
  const int rows = GDALGetRasterBandYSize(band);
  std::vector<double> values(static_cast<std::size_t>(columns) * static_cast<std::size_t>(rows));
  if (GDALRasterIO(band, GF_Read, 0, 0, columns, rows, values.data(), columns, rows, GDT_Float64, 0,
                   0) != CE_None ||
      session.Failed()) {
    return Truncated("its cells cannot be read" + session.Complaint());
  }
  if (Status masked = ApplyMask(band, session, values); !masked) return std::move(masked.error());
  bool any = false;
  for (std::size_t i = 0; i < values.size(); ++i) {
    double& value = values[i];
    if (nodata.Matches(value)) {
      value = std::numeric_limits<double>::quiet_NaN();
      continue;
    }
    any = true;
    if (std::isinf(value)) {
      return BadData(
          CellName(i, columns) + " is infinite; name the value that means no data with --nodata",
          "infinite-height");
    }
    if (std::abs(value) >= kMaxHeight ||
        std::abs(value * scale.scale + scale.offset) >= kMaxHeight) {
      return BadData(CellName(i, columns) + " is " + std::to_string(value) +
                         ", which is no height; name the value that means no data with --nodata",
                     "height-out-of-range");
    }
  }
  if (!any) return BadData("no cell of the raster has data", "all-nodata");
  return values;
}

Result<Dem> ReadOpened(GDALDatasetH dataset, const std::filesystem::path& path,
                       const DemReadOptions& options, GdalSession& session) {
  if (Status fits = CheckSize(dataset, options); !fits) return std::move(fits.error());
  const GDALRasterBandH band = GDALGetRasterBand(dataset, 1);
  if (Status typed = CheckType(band); !typed) return std::move(typed.error());
  if (Status fits = CheckBlock(band, options); !fits) return std::move(fits.error());
  const NoDataRule nodata(band, options.nodata);
  if (Status whole = CheckComplete(dataset, path, nodata.given()); !whole) {
    return std::move(whole.error());
  }
  Result<GeoTransform> transform = ReadGeoTransform(dataset);
  if (!transform) return std::move(transform.error());
  Result<std::string> crs = ReadCrs(dataset, options.crs);
  if (!crs) return std::move(crs.error());
  Assumptions assumptions;
  Result<ValueScale> scale = ReadValueScale(dataset, band, options, assumptions);
  if (!scale) return std::move(scale.error());
  session.Forget();
  Result<std::vector<double>> values = ReadValues(band, nodata, *scale, session);
  if (!values) return std::move(values.error());
  if (scale->scale < 0) {
    for (double& value : *values) value = -value;
    scale->scale = -scale->scale;
  }

  ScaledHeights scaled = ScaleHeights(*values);
  Dem dem;
  dem.columns = GDALGetRasterXSize(dataset);
  dem.rows = GDALGetRasterYSize(dataset);
  dem.heights = std::move(scaled.heights);
  dem.quantum_m = scaled.quantum * scale->scale;
  dem.height_offset_m = scaled.offset * scale->scale + scale->offset;
  dem.quantized = scaled.quantized;
  dem.transform = *transform;
  dem.crs = *crs;
  dem.assumptions = std::move(assumptions);
  return dem;
}

}  // namespace

Result<Dem> ReadDem(const std::filesystem::path& path, const DemReadOptions& options) {
  GdalSession session(path);
  Result<OpenedRaster> raster = OpenRaster(path, options.max_posts, session);
  if (!raster) return std::move(raster.error());
  Result<Dem> dem = ReadOpened(raster->dataset.get(), path, options, session);
  if (dem)
    dem->assumptions.insert(dem->assumptions.begin(), raster->assumptions.begin(),
                            raster->assumptions.end());
  return dem;
}

}  // namespace farhorizon
