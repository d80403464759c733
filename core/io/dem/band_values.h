#pragma once

#include <filesystem>
#include <optional>
#include <vector>

#include "core/base/assumption.h"
#include "core/base/result.h"
#include "core/io/dem/aux_file.h"
#include "core/io/dem/height_band.h"
#include "core/io/dem/read_dem.h"
#include "core/io/dem/tiff/tiff_blocks.h"
#include "core/io/dem/tiff/tiff_file.h"
#include "core/io/dem/values/sample_type.h"
#include "core/io/gdal_session.h"

namespace farhorizon {

/// What is at hand while one raster is read.
struct OpenedDem {
  void* dataset = nullptr;  ///< a GDALDatasetH
  const std::filesystem::path& path;
  const DemReadOptions& options;
  GdalSession& session;
  std::optional<TiffFile> tiff = {};
  HeightBand band = {};
  AuxTags aux = {};
  Assumptions assumptions = {};

  /// nullptr for other formats.
  [[nodiscard]] TiffFile* Tiff() { return tiff ? &*tiff : nullptr; }
};

/// What the header of a file, and the auxiliary file beside it, say of its values.
struct ValueTags {
  SampleType samples;
  std::vector<double> nodata;
  AbsentBlocks absent;
};

/// Reads the tags of the values of `dem`. Scale, offset and unit that stand beside the usual places
/// are put into its dataset, geotransform and reference system of the auxiliary file into
/// `dem.aux`.
/// Errors: kUnsupportedData, kinds "unsupported-type", "truncated".
Result<ValueTags> ReadValueTags(OpenedDem& dem);

/// Reads the raw values of the band of heights, rows x columns, NaN where there is no data: by the
/// nodata values of the file and of the call, masks, and blocks left out of a sparse file. Decides
/// `tags.samples` where the file leaves their format open.
/// Errors: kUnsupportedData, kind "truncated". Cost: 8 bytes a post.
Result<std::vector<double>> ReadValues(OpenedDem& dem, ValueTags& tags);

}  // namespace farhorizon
