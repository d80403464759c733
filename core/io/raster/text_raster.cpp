// Hands grids that core/io/text_grid reads to the rest of the reader as datasets of GDAL's driver
// for memory, so that text goes the way of all other formats from there.
#include "core/io/raster/text_raster.h"

#include <array>
#include <string>
#include <utility>
#include <vector>

#include <cpl_conv.h>
#include <cpl_string.h>
#include <gdal.h>
#include <ogr_srs_api.h>

#include "core/geo/named_files.h"
#include "core/io/file.h"
#include "core/io/text_grid/arc_grid.h"
#include "core/io/text_grid/grass_grid.h"
#include "core/io/text_grid/surfer_grid.h"
#include "core/io/text_grid/xyz_list.h"

namespace farhorizon {

namespace {

Error NoMemory(std::int64_t columns, std::int64_t rows) {
  return {ErrorCode::kResourceExhausted,
          "no memory for the raster's " + std::to_string(columns) + " x " + std::to_string(rows) +
              " cells",
          "memory-limit"};
}

// A dataset of the size of `grid` whose rows all lie in one row of zeros, each a cell further on:
// it takes no memory for cells that nobody reads. It must be closed before `zeros` goes.
Result<RasterPtr> Unread(const TextGrid& grid, std::vector<float>& zeros) {
  const auto columns = static_cast<int>(grid.columns);
  const auto rows = static_cast<int>(grid.rows);
  zeros.assign(static_cast<std::size_t>(grid.columns + grid.rows), 0);
  std::array<char, 32> address{};
  const int length = CPLPrintPointer(address.data(), zeros.data(), address.size() - 1);
  CPLStringList options;
  options.SetNameValue("DATAPOINTER",
                       std::string(address.data(), static_cast<std::size_t>(length)).c_str());
  options.SetNameValue("PIXELOFFSET", std::to_string(sizeof(float)).c_str());
  options.SetNameValue("LINEOFFSET", std::to_string(sizeof(float)).c_str());
  RasterPtr dataset(
      GDALCreate(GDALGetDriverByName("MEM"), "", columns, rows, 0, GDT_Float32, nullptr));
  std::array<double, 6> transform = grid.geotransform;
  if (!dataset || GDALAddBand(dataset.get(), GDT_Float32, options.List()) != CE_None ||
      GDALSetGeoTransform(dataset.get(), transform.data()) != CE_None) {
    return NoMemory(grid.columns, grid.rows);
  }
  return dataset;
}

Result<RasterPtr> InMemory(const TextGrid& grid) {
  const auto columns = static_cast<int>(grid.columns);
  const auto rows = static_cast<int>(grid.rows);
  const GDALDataType type = grid.cells.is_float() ? GDT_Float32 : GDT_Int32;
  RasterPtr dataset(GDALCreate(GDALGetDriverByName("MEM"), "", columns, rows, 1, type, nullptr));
  const GDALRasterBandH band = dataset ? GDALGetRasterBand(dataset.get(), 1) : nullptr;
  // GF_Write only reads the buffer.
  void* cells = const_cast<void*>(grid.cells.data());  // NOLINT(*-const-cast)
  std::array<double, 6> transform = grid.geotransform;
  if (band == nullptr || GDALSetGeoTransform(dataset.get(), transform.data()) != CE_None ||
      GDALRasterIO(band, GF_Write, 0, 0, columns, rows, cells, columns, rows, type, 0, 0) !=
          CE_None) {
    return NoMemory(grid.columns, grid.rows);
  }
  if (grid.nodata) GDALSetRasterNoDataValue(band, *grid.nodata);
  return dataset;
}

bool IsInSeconds(char** lines) {
  for (int i = 0; lines[i] != nullptr; ++i) {
    CPLStringList words(CSLTokenizeString(lines[i]));
    if (words.Count() > 1 && EQUAL(words[0], "Units")) return EQUAL(words[1], "DS");
  }
  return false;
}

// The .prj beside an Arc/Info grid, in Esri's WKT or in Arc/Info's keywords. Degrees may be in
// seconds there ("Units DS"), as GDAL's driver reads them.
void AddReferenceSystem(const std::filesystem::path& path, GDALDatasetH dataset) {
  constexpr std::uintmax_t kMaxPrjBytes = 65536;
  for (const char* ending : {".prj", ".PRJ"}) {
    std::filesystem::path beside = path;
    Result<std::string> text = ReadFile(beside.replace_extension(ending), kMaxPrjBytes);
    if (!text || NamedFileIn(*text) != nullptr) continue;
    CPLStringList lines(CSLTokenizeString2(text->c_str(), "\r\n", 0));
    const OGRSpatialReferenceH system = OSRNewSpatialReference(nullptr);
    OSRSetAxisMappingStrategy(system, OAMS_TRADITIONAL_GIS_ORDER);
    if (OSRImportFromESRI(system, lines.List()) == OGRERR_NONE) {
      if (OSRIsGeographic(system) != 0 && IsInSeconds(lines.List())) {
        double transform[6];
        GDALGetGeoTransform(dataset, transform);
        for (double& number : transform) number /= 3600;
        GDALSetGeoTransform(dataset, transform);
      }
      GDALSetSpatialRef(dataset, system);
    }
    OSRDestroySpatialReference(system);
    return;
  }
}

Result<XyzGrid> ReadGrid(const std::filesystem::path& path, FileKind kind,
                         const GridLimits& limits) {
  if (kind == FileKind::kXyz) return ReadXyzList(path, limits);
  Result<TextGrid> grid = kind == FileKind::kGrassGrid    ? ReadGrassGrid(path, limits)
                          : kind == FileKind::kSurferText ? ReadSurferGrid(path, limits)
                                                          : ReadArcGrid(path, limits);
  if (!grid) return std::move(grid.error());
  return XyzGrid{std::move(*grid), true};
}

}  // namespace

Result<OpenedRaster> OpenTextRaster(const std::filesystem::path& path, FileKind kind,
                                    const GridLimits& limits) {
  Result<XyzGrid> read = ReadGrid(path, kind, limits);
  if (!read) return std::move(read.error());
  const bool unread = read->grid.cells.size() == 0;
  OpenedRaster opened;
  Result<RasterPtr> dataset = unread ? Unread(read->grid, opened.unread) : InMemory(read->grid);
  if (!dataset) return std::move(dataset.error());
  if (kind == FileKind::kArcGrid) AddReferenceSystem(path, dataset->get());
  opened.dataset = std::move(*dataset);
  if (kind == FileKind::kXyz && !read->order_is_stated) {
    opened.assumptions.push_back(
        {"xyz-order",
         "the list of points does not name its columns, which were taken for x (easting or "
         "longitude), y (northing or latitude) and height; a first line such as \"y x z\" states "
         "another order"});
  }
  return opened;
}

}  // namespace farhorizon
