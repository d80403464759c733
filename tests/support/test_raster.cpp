#include "tests/support/test_raster.h"

#include <memory>
#include <stdexcept>

#include <cpl_conv.h>
#include <cpl_string.h>
#include <gdal.h>
#include <gdal_frmts.h>
#include <ogr_srs_api.h>

namespace farhorizon {
namespace {

void Must(bool done, const char* what) {
  if (!done) throw std::runtime_error(std::string(what) + ": " + CPLGetLastErrorMsg());
}

std::string WktOf(const std::string& text) {
  const OGRSpatialReferenceH crs = OSRNewSpatialReference(nullptr);
  Must(OSRSetFromUserInput(crs, text.c_str()) == OGRERR_NONE, "crs");
  char* wkt = nullptr;
  Must(OSRExportToWkt(crs, &wkt) == OGRERR_NONE, "wkt");
  std::string result = wkt;
  CPLFree(wkt);
  OSRDestroySpatialReference(crs);
  return result;
}

void DescribeBand(GDALRasterBandH band, const TestRaster& raster) {
  if (raster.nodata) Must(GDALSetRasterNoDataValue(band, *raster.nodata) == CE_None, "nodata");
  if (raster.scale) Must(GDALSetRasterScale(band, *raster.scale) == CE_None, "scale");
  if (raster.offset) Must(GDALSetRasterOffset(band, *raster.offset) == CE_None, "offset");
  if (!raster.unit.empty()) {
    Must(GDALSetRasterUnitType(band, raster.unit.c_str()) == CE_None, "unit");
  }
  if (raster.colour_table) {
    const GDALColorTableH table = GDALCreateColorTable(GPI_RGB);
    const GDALColorEntry red = {255, 0, 0, 255};
    GDALSetColorEntry(table, 0, &red);
    Must(GDALSetRasterColorTable(band, table) == CE_None, "colour table");
    GDALDestroyColorTable(table);
  }
}

void WriteMask(GDALDatasetH dataset, const TestRaster& raster) {
  CPLSetThreadLocalConfigOption("GDAL_TIFF_INTERNAL_MASK", "YES");
  Must(GDALCreateDatasetMaskBand(dataset, GMF_PER_DATASET) == CE_None, "mask");
  std::vector<unsigned char> mask;
  for (const int m : raster.mask) mask.push_back(m != 0 ? 255 : 0);
  Must(GDALRasterIO(GDALGetMaskBand(GDALGetRasterBand(dataset, 1)), GF_Write, 0, 0, raster.columns,
                    raster.rows, mask.data(), raster.columns, raster.rows, GDT_Byte, 0,
                    0) == CE_None,
       "mask");
  CPLSetThreadLocalConfigOption("GDAL_TIFF_INTERNAL_MASK", nullptr);
}

}  // namespace

void WriteTiff(const std::filesystem::path& path, const TestRaster& raster) {
  GDALRegister_GTiff();
  CPLStringList options;
  for (const std::string& option : raster.options) options.AddString(option.c_str());
  const GDALDatasetH dataset =
      GDALCreate(GDALGetDriverByName("GTiff"), path.c_str(), raster.columns, raster.rows,
                 raster.bands, GDALGetDataTypeByName(raster.type.c_str()), options.List());
  Must(dataset != nullptr, "create");
  if (raster.geotransform) {
    std::array<double, 6> g = *raster.geotransform;
    Must(GDALSetGeoTransform(dataset, g.data()) == CE_None, "geotransform");
  }
  if (!raster.crs.empty()) {
    Must(GDALSetProjection(dataset, WktOf(raster.crs).c_str()) == CE_None, "projection");
  }
  for (const auto& [key, value] : raster.metadata) {
    Must(GDALSetMetadataItem(dataset, key.c_str(), value.c_str(), nullptr) == CE_None, "metadata");
  }
  DescribeBand(GDALGetRasterBand(dataset, 1), raster);
  if (!raster.mask.empty()) WriteMask(dataset, raster);
  if (raster.alpha_band != 0) {
    GDALSetRasterColorInterpretation(GDALGetRasterBand(dataset, 3 - raster.alpha_band),
                                     GCI_GrayIndex);
    Must(GDALSetRasterColorInterpretation(GDALGetRasterBand(dataset, raster.alpha_band),
                                          GCI_AlphaBand) == CE_None,
         "alpha");
  }
  for (int b = 1; b <= raster.bands && !raster.values.empty(); ++b) {
    std::vector<double> values = raster.band_values.empty()
                                     ? raster.values
                                     : raster.band_values[static_cast<std::size_t>(b - 1)];
    Must(GDALRasterIO(GDALGetRasterBand(dataset, b), GF_Write, 0, 0, raster.columns, raster.rows,
                      values.data(), raster.columns, raster.rows, GDT_Float64, 0, 0) == CE_None,
         "write");
  }
  GDALClose(dataset);
}

}  // namespace farhorizon
