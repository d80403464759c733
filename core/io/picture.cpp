// A picture is a raster of one byte band in memory, which GDAL's driver copies to a file in memory.
#include "core/io/picture.h"

#include <memory>
#include <utility>

#include <cpl_string.h>
#include <cpl_vsi.h>
#include <gdal.h>

#include "core/io/gdal_session.h"

namespace farhorizon {

namespace {

struct CloseDataset {
  void operator()(void* dataset) const { GDALClose(dataset); }
};
using DatasetPtr = std::unique_ptr<void, CloseDataset>;

struct DestroyColours {
  void operator()(void* table) const { GDALDestroyColorTable(table); }
};

// A file in memory, gone with this object.
class MemoryFile {
 public:
  explicit MemoryFile(const std::string& name) : path_("/vsimem/" + name) {}
  MemoryFile(const MemoryFile&) = delete;
  MemoryFile& operator=(const MemoryFile&) = delete;
  ~MemoryFile() { VSIUnlink(path_.c_str()); }

  [[nodiscard]] const std::string& path() const { return path_; }
  [[nodiscard]] std::string Bytes() const {
    vsi_l_offset size = 0;
    const GByte* bytes = VSIGetMemFileBuffer(path_.c_str(), &size, FALSE);
    if (bytes == nullptr) return {};
    return {reinterpret_cast<const char*>(bytes), static_cast<std::size_t>(size)};
  }

 private:
  std::string path_;
};

// The raster of `values`; null where GDAL has no memory for it.
DatasetPtr RasterOf(int width, int height, const std::vector<std::uint8_t>& values) {
  DatasetPtr raster(
      GDALCreate(GDALGetDriverByName("MEM"), "", width, height, 1, GDT_Byte, nullptr));
  if (!raster) return raster;
  // GDALRasterIO has one signature for both ways; writing leaves the buffer as it is.
  auto* const pixels = const_cast<std::uint8_t*>(values.data());
  const CPLErr written = GDALRasterIO(GDALGetRasterBand(raster.get(), 1), GF_Write, 0, 0, width,
                                      height, pixels, width, height, GDT_Byte, 0, 0);
  return written == CE_None ? std::move(raster) : DatasetPtr();
}

// What the driver makes of `raster`.
Result<std::string> Encode(const char* driver, const DatasetPtr& raster, const std::string& option,
                           const GdalSession& session) {
  // Two sessions that live at a time have different addresses.
  const MemoryFile file("picture-" + std::to_string(reinterpret_cast<std::uintptr_t>(&session)));
  const char* const options[] = {option.c_str(), nullptr};
  DatasetPtr copy;
  if (raster) {
    copy.reset(GDALCreateCopy(GDALGetDriverByName(driver), file.path().c_str(), raster.get(), FALSE,
                              options, nullptr, nullptr));
  }
  const bool made = copy != nullptr;
  copy.reset();  // writes what is left
  if (!made || session.Failed()) {
    return Error{ErrorCode::kIo, "cannot make a picture" + session.Complaint()};
  }
  return file.Bytes();
}

}  // namespace

Result<std::string> EncodeJpeg(const GreyPicture& picture, int quality) {
  const GdalSession session("/vsimem");
  return Encode("JPEG", RasterOf(picture.width, picture.height, picture.values),
                "QUALITY=" + std::to_string(quality), session);
}

Result<std::string> EncodePng(const PalettePicture& picture) {
  const GdalSession session("/vsimem");
  const DatasetPtr raster = RasterOf(picture.width, picture.height, picture.values);
  if (raster) {
    const std::unique_ptr<void, DestroyColours> colours(GDALCreateColorTable(GPI_RGB));
    for (std::size_t i = 0; i < picture.palette.size(); ++i) {
      const auto& [red, green, blue, opacity] = picture.palette[i];
      const GDALColorEntry entry = {red, green, blue, opacity};
      GDALSetColorEntry(colours.get(), static_cast<int>(i), &entry);
    }
    GDALSetRasterColorTable(GDALGetRasterBand(raster.get(), 1), colours.get());
  }
  return Encode("PNG", raster, "ZLEVEL=6", session);
}

}  // namespace farhorizon
