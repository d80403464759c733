#include "core/io/dem/complete_raster.h"

#include <cstdint>
#include <cstdlib>
#include <string_view>

#include <gdal.h>

namespace farhorizon {

namespace {

// GDAL fills blocks that a TIFF leaves out with nodata, or with zeros where the band has none. In a
// file that was cut short such zeros would be taken for ground.
Status CheckTiffBlocks(GDALRasterBandH band, std::uintmax_t file_bytes, bool has_nodata) {
  int width = 0;
  int height = 0;
  GDALGetBlockSize(band, &width, &height);
  const int across = (GDALGetRasterBandXSize(band) + width - 1) / width;
  const int down = (GDALGetRasterBandYSize(band) + height - 1) / height;
  for (int y = 0; y < down; ++y) {
    for (int x = 0; x < across; ++x) {
      const std::string block = std::to_string(x) + "_" + std::to_string(y);
      const auto number = [&](const std::string& key) -> std::uintmax_t {
        const char* text = GDALGetMetadataItem(band, (key + block).c_str(), "TIFF");
        return text != nullptr ? std::strtoull(text, nullptr, 10) : 0;
      };
      const std::uintmax_t offset = number("BLOCK_OFFSET_");
      const std::uintmax_t bytes = number("BLOCK_SIZE_");
      const std::string name = "block (" + std::to_string(x) + ", " + std::to_string(y) + ")";
      if (offset == 0 && !has_nodata) return Truncated(name + " is missing");
      if (offset > file_bytes || bytes > file_bytes - offset) {
        return Truncated(name + " lies beyond the end of the file");
      }
    }
  }
  return Ok{};
}

}  // namespace

Error Truncated(const std::string& what) {
  return {ErrorCode::kUnsupportedData,
          "the raster is not complete: " + what + "; fetch or make the file again", "truncated"};
}

Status CheckComplete(void* dataset, const std::filesystem::path& path, bool has_nodata) {
  const GDALRasterBandH band = GDALGetRasterBand(dataset, 1);
  std::error_code failure;
  const std::uintmax_t bytes = std::filesystem::file_size(path, failure);
  if (failure) {
    return Error{ErrorCode::kIo, "the size of " + path.filename().string() + " cannot be read"};
  }
  const std::int64_t posts =
      std::int64_t{GDALGetRasterBandXSize(band)} * GDALGetRasterBandYSize(band);
  const std::string_view driver = GDALGetDriverShortName(GDALGetDatasetDriver(dataset));
  if (driver == "GTiff") return CheckTiffBlocks(band, bytes, has_nodata);
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
