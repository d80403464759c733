// Hands grids that core/io/text_grid reads to the rest of the reader as datasets of GDAL's driver
// for memory, so that text goes the way of all other formats from there.
#include "core/io/raster/text_raster.h"

#include <array>
#include <string>
#include <utility>

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
    return Error{ErrorCode::kResourceExhausted,
                 "no memory for the raster's " + std::to_string(columns) + " x " +
                     std::to_string(rows) + " cells",
                 "memory-limit"};
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

Result<XyzGrid> ReadGrid(const std::filesystem::path& path, FileKind kind, std::int64_t max_cells) {
  if (kind == FileKind::kXyz) return ReadXyzList(path, max_cells);
  Result<TextGrid> grid = kind == FileKind::kGrassGrid    ? ReadGrassGrid(path, max_cells)
                          : kind == FileKind::kSurferText ? ReadSurferGrid(path, max_cells)
                                                          : ReadArcGrid(path, max_cells);
  if (!grid) return std::move(grid.error());
  return XyzGrid{std::move(*grid), true};
}

}  // namespace

Result<OpenedRaster> OpenTextRaster(const std::filesystem::path& path, FileKind kind,
                                    std::int64_t max_cells) {
  Result<XyzGrid> read = ReadGrid(path, kind, max_cells);
  if (!read) return std::move(read.error());
  Result<RasterPtr> dataset = InMemory(read->grid);
  if (!dataset) return std::move(dataset.error());
  if (kind == FileKind::kArcGrid) AddReferenceSystem(path, dataset->get());
  OpenedRaster opened{std::move(*dataset), {}};
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
