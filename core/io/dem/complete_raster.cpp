#include "core/io/dem/complete_raster.h"

#include <cstdint>
#include <cstdlib>
#include <string_view>

#include <gdal.h>

namespace farhorizon {

Error Truncated(const std::string& what) {
  return {ErrorCode::kUnsupportedData,
          "the raster is not complete: " + what + "; fetch or make the file again", "truncated"};
}

Status CheckComplete(void* dataset, const std::filesystem::path& path) {
  const GDALRasterBandH band = GDALGetRasterBand(dataset, 1);
  std::error_code failure;
  const std::uintmax_t bytes = std::filesystem::file_size(path, failure);
  if (failure) {
    return Error{ErrorCode::kIo, "the size of " + path.filename().string() + " cannot be read"};
  }
  const std::int64_t posts =
      std::int64_t{GDALGetRasterBandXSize(band)} * GDALGetRasterBandYSize(band);
  const std::string_view driver = GDALGetDriverShortName(GDALGetDatasetDriver(dataset));
  if (driver == "ENVI") {
    const char* text = GDALGetMetadataItem(dataset, "header_offset", "ENVI");
    const std::uintmax_t start = text != nullptr ? std::strtoull(text, nullptr, 10) : 0;
    const auto wanted =
        static_cast<std::uintmax_t>(posts) *
        static_cast<std::uintmax_t>(GDALGetDataTypeSizeBytes(GDALGetRasterDataType(band)));
    if (start > bytes || wanted > bytes - start) {
      return Truncated("the file has " + std::to_string(bytes) + " of " +
                       std::to_string(start + wanted) + " bytes");
    }
  }
  return Ok{};
}

}  // namespace farhorizon
