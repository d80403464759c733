#include "tests/support/format_raster.h"

#include <stdexcept>

#include <cpl_conv.h>
#include <cpl_string.h>
#include <gdal.h>
#include <gdal_frmts.h>

#include "tests/support/temp_dir.h"

namespace farhorizon {

void WriteWithDriver(const std::filesystem::path& path, const std::string& driver,
                     const TestRaster& raster, const std::vector<std::string>& options) {
  GDALRegister_AAIGrid();
  GDALRegister_EHdr();
  GDALRegister_ENVI();
  GDALRegister_GS7BG();
  GDALRegister_GSAG();
  GDALRegister_GSBG();
  GDALRegister_HFA();
  GDALRegister_XYZ();
  const TempDir dir;
  WriteTiff(dir / "source.tif", raster);
  CPLSetThreadLocalConfigOption("GDAL_PAM_ENABLED", "NO");
  const GDALDatasetH source = GDALOpen((dir / "source.tif").c_str(), GA_ReadOnly);
  CPLStringList list;
  for (const std::string& option : options) list.AddString(option.c_str());
  const GDALDatasetH copy = GDALCreateCopy(GDALGetDriverByName(driver.c_str()), path.c_str(),
                                           source, 0, list.List(), nullptr, nullptr);
  if (copy == nullptr) throw std::runtime_error(driver + ": " + CPLGetLastErrorMsg());
  GDALClose(copy);
  GDALClose(source);
  CPLSetThreadLocalConfigOption("GDAL_PAM_ENABLED", nullptr);
}

TestRaster DistinctHeights(int columns, int rows) {
  TestRaster raster{.columns = columns, .rows = rows, .type = "Float32", .values = {}};
  for (int i = 0; i < columns * rows; ++i) raster.values.push_back(100 + i + 0.25 * (i % 4));
  return raster;
}

}  // namespace farhorizon
