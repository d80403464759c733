// Reads a DEM through GDAL without trusting the file: all that can be refused from the header is
// refused before the first pixel is read. GdalSession keeps GDAL from opening other files.
#include "core/io/dem/read_dem.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <iterator>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <gdal.h>

#include "core/geo/named_files.h"
#include "core/io/dem/band_values.h"
#include "core/io/dem/complete_raster.h"
#include "core/io/dem/height_band.h"
#include "core/io/dem/place/raster_place.h"
#include "core/io/dem/raster_limits.h"
#include "core/io/dem/values/fill_cliffs.h"
#include "core/io/dem/values/height_quantum.h"
#include "core/io/dem/values/untagged_voids.h"
#include "core/io/dem/values/value_scale.h"
#include "core/io/gdal_session.h"
#include "core/io/raster/open_raster.h"

namespace farhorizon {

namespace {

// Opens the tags of a TIFF, finds the band of heights and checks that the file holds all of it.
Status FindHeights(OpenedDem& opened) {
  const std::string_view driver = GDALGetDriverShortName(GDALGetDatasetDriver(opened.dataset));
  if (driver == "GTiff") {
    opened.tiff = TiffFile::Open(opened.path);
    if (!opened.tiff) return Truncated("the list of its tags cannot be read");
    // GDAL looks at the reference system when it is asked for the first time, which is later.
    for (std::size_t i = 0; i < opened.tiff->size(); ++i) {
      const std::string text =
          opened.tiff->WholeText(i, TiffTag::kGeoAsciiParams, std::uint64_t{1} << 24U);
      if (NamesFileSomewhere(text)) return SystemNamesFile("the raster's");
    }
  }
  Result<HeightBand> band = FindHeightBand(opened.dataset, opened.Tiff());
  if (!band) return std::move(band.error());
  opened.band = *band;
  if (Status fits = CheckRasterLimits(band->heights, opened.options.max_posts); !fits) return fits;
  return CheckComplete(opened.dataset, opened.path);
}

// The posts that GDAL decodes for all heights, or for one where that is more: blocks go as a whole.
std::int64_t CostOf(GDALRasterBandH band) {
  int width = 0;
  int height = 0;
  GDALGetBlockSize(band, &width, &height);
  return std::max(std::int64_t{width} * height,
                  std::int64_t{GDALGetRasterBandXSize(band)} * GDALGetRasterBandYSize(band));
}

// Judges the values by the heights that they would be, with `scale`.
Status JudgeHeights(const SampleType& samples, const ValueScale& scale, int columns,
                    std::vector<double>& values, Assumptions& assumptions) {
  if (Status sound = LeaveOutUntaggedVoids(samples, scale, columns, values, assumptions); !sound) {
    return sound;
  }
  if (std::ranges::all_of(values, [](double value) { return std::isnan(value); })) {
    return Error{ErrorCode::kUnsupportedData, "no cell of the raster has data", "all-nodata"};
  }
  SayFillsWithCliffs(values, columns, samples, scale, assumptions);
  return Ok{};
}

// Heights as the sweep takes them: integers of a positive quantum.
void SetHeights(std::vector<double> values, ValueScale scale, Dem& dem) {
  if (scale.scale < 0) {
    for (double& value : values) value = -value;
    scale.scale = -scale.scale;
  }
  ScaledHeights scaled = ScaleHeights(values);
  dem.heights = std::move(scaled.heights);
  dem.quantum_m = scaled.quantum * scale.scale;
  dem.height_offset_m = scaled.offset * scale.scale + scale.offset;
  dem.quantized = scaled.quantized;
}

Result<Dem> ReadOpened(OpenedDem opened) {
  const DemReadOptions& options = opened.options;
  Dem dem;
  dem.columns = GDALGetRasterXSize(opened.dataset);
  dem.rows = GDALGetRasterYSize(opened.dataset);
  if (Status found = FindHeights(opened); !found) return std::move(found.error());
  Result<ValueTags> tags = ReadValueTags(opened);
  if (!tags) return std::move(tags.error());
  Result<GeoTransform> transform = ReadGeoTransform(opened);
  if (!transform) return std::move(transform.error());
  dem.transform = *transform;
  Assumptions about_crs;
  const Result<std::string> crs = ReadFileCrs(opened, about_crs);
  if (!crs && !options.crs) return crs.error();
  dem.crs = options.crs ? *options.crs : *crs;
  if (!options.crs) std::ranges::copy(about_crs, std::back_inserter(opened.assumptions));
  Result<ValueScale> scale =
      ReadValueScale(opened, crs ? std::optional(*crs) : std::optional<std::string>());
  if (!scale) return std::move(scale.error());

  if (CostOf(opened.band.heights) > options.most_decoded) {
    dem.assumptions = std::move(opened.assumptions);
    return dem;
  }
  Result<std::vector<double>> values = ReadValues(opened, *tags);
  if (!values) return std::move(values.error());
  if (Status sound = JudgeHeights(tags->samples, *scale, dem.columns, *values, opened.assumptions);
      !sound) {
    return std::move(sound.error());
  }
  SetHeights(std::move(*values), *scale, dem);
  dem.assumptions = std::move(opened.assumptions);
  return dem;
}

}  // namespace

Result<Dem> ReadDem(const std::filesystem::path& path, const DemReadOptions& options) {
  GdalSession session(path);
  Result<OpenedRaster> raster =
      OpenRaster(path, {options.max_posts, options.most_decoded}, session);
  if (!raster) return std::move(raster.error());
  return ReadOpened({.dataset = raster->dataset.get(),
                     .path = path,
                     .options = options,
                     .session = session,
                     .assumptions = std::move(raster->assumptions)});
}

}  // namespace farhorizon
