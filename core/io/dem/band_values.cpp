// Header first: the tags of the file, of its directory and of the file beside are gathered before a
// sample is read. Then one pass of GDAL's reads the samples, and all that hides posts is applied in
// turn: nodata values, masks, absent blocks.
#include "core/io/dem/band_values.h"

#include <limits>
#include <string>
#include <utility>

#include <gdal.h>

#include "core/io/dem/aux_file.h"
#include "core/io/dem/band_mask.h"
#include "core/io/dem/complete_raster.h"
#include "core/io/dem/tiff/tiff_images.h"
#include "core/io/dem/values/model_scale.h"
#include "core/io/dem/values/nodata_rule.h"

namespace farhorizon {

namespace {

// The blocks that a sparse file leaves out mean its nodata value or, without one, 0.
void FillAbsentBlocks(const ValueTags& tags, int columns, std::vector<double>& values,
                      Assumptions& assumptions) {
  if (tags.absent.places.empty()) return;
  if (!tags.nodata.empty()) {
    HidePlaces(tags.absent.places, columns, values);
    return;
  }
  assumptions.push_back(
      {"absent-blocks",
       std::to_string(tags.absent.places.size()) + " of the file's " +
           std::to_string(tags.absent.blocks) +
           " blocks are left out of it (a sparse file, or one that was never finished) and were "
           "read as heights of 0, since it names no nodata value; if they mean no data, "
           "gdal_translate -a_nodata -9999 IN OUT makes them so"});
}

}  // namespace

Result<ValueTags> ReadValueTags(OpenedDem& dem) {
  ValueTags tags;
  Result<SampleType> samples = ReadSampleType(dem.band.heights, dem.Tiff());
  if (!samples) return std::move(samples.error());
  tags.samples = *samples;
  tags.nodata = ReadNodataTags(dem.band.heights, dem.Tiff(), dem.assumptions);
  if (dem.tiff) {
    Result<AbsentBlocks> absent = FindAbsentBlocks(*dem.tiff, dem.band.number);
    if (!absent) return std::move(absent.error());
    tags.absent = std::move(*absent);
    SayWhichImage(*dem.tiff, dem.assumptions);
    ApplyModelScale(dem.band.heights, *dem.tiff, dem.assumptions);
  }
  dem.aux = ReadAuxFile(dem.path, dem.dataset, dem.band.number, dem.options, dem.assumptions);
  tags.nodata.insert(tags.nodata.end(), dem.aux.nodata.begin(), dem.aux.nodata.end());
  return tags;
}

Result<std::vector<double>> ReadValues(OpenedDem& dem, ValueTags& tags) {
  const int columns = GDALGetRasterBandXSize(dem.band.heights);
  const int rows = GDALGetRasterBandYSize(dem.band.heights);
  std::vector<double> values(static_cast<std::size_t>(columns) * static_cast<std::size_t>(rows));
  dem.session.Forget();
  if (GDALRasterIO(dem.band.heights, GF_Read, 0, 0, columns, rows, values.data(), columns, rows,
                   GDT_Float64, 0, 0) != CE_None ||
      dem.session.Failed()) {
    return Truncated("its cells cannot be read" + dem.session.Complaint());
  }
  DecideUndefinedFormat(values, tags.nodata, tags.samples, dem.assumptions);
  SayTagsWithoutSamples(tags.nodata, tags.samples, dem.assumptions);
  std::vector<double> named = tags.nodata;
  named.insert(named.end(), dem.options.nodata.begin(), dem.options.nodata.end());
  const NoDataRule nodata(tags.samples, named);
  for (double& value : values) {
    value = tags.samples.Meant(value);
    if (nodata.Matches(value)) value = std::numeric_limits<double>::quiet_NaN();
  }
  FillAbsentBlocks(tags, columns, values, dem.assumptions);
  if (Status masked = ApplyMasks(dem.band, dem.path, dem.session, values, dem.assumptions);
      !masked) {
    return std::move(masked.error());
  }
  return values;
}

}  // namespace farhorizon
