#include "raster.h"

#include <cmath>
#include <limits>
#include <map>
#include <numbers>
#include <utility>

#include <gdal_priv.h>
#include <ogr_spatialref.h>

namespace farhorizon::peers {

namespace {

/// Metres in a unit of the band's heights. Files that say nothing mean metres.
double MetresOf(const std::string& unit) {
  static const std::map<std::string, double> kUnits = {
      {"", 1},        {"m", 1},         {"metre", 1},
      {"meter", 1},   {"metres", 1},    {"meters", 1},
      {"ft", 0.3048}, {"foot", 0.3048}, {"US survey foot", 1200. / 3937}};
  const auto found = kUnits.find(unit);
  if (found == kUnits.end()) Fail("heights in '" + unit + "': the contest knows metres and feet");
  return found->second;
}

/// Moves `points` from one system to another, x east and y north in both.
void Transform(const OGRSpatialReference& from, const OGRSpatialReference& to,
               std::vector<Point>& points) {
  const std::unique_ptr<OGRCoordinateTransformation> way(
      OGRCreateCoordinateTransformation(&from, &to));
  if (!way) Fail("PROJ knows no way between two reference systems");
  for (Point& p : points)
    if (!way->Transform(1, &p.x, &p.y, &p.z)) Fail("a point has no place in a reference system");
}

/// Leaves a system its projection, its unit of angles and its prime meridian.
void TakeDatumForWgs84(OGRSpatialReference& system) {
  const char *meridian = nullptr, *unit = nullptr;
  const double offset = system.GetPrimeMeridian(&meridian);
  const double angle = system.GetAngularUnits(&unit);
  OGRSpatialReference geographic;
  geographic.SetGeogCS("the raster's, on WGS 84", "WGS_1984", "WGS 84", SRS_WGS84_SEMIMAJOR,
                       SRS_WGS84_INVFLATTENING, meridian, offset, unit, angle);
  if (system.IsGeographic())
    system = geographic;
  else
    system.CopyGeogCSFrom(&geographic);
  system.SetAxisMappingStrategy(OAMS_TRADITIONAL_GIS_ORDER);
}

OGRSpatialReference SystemOf(int epsg) {
  OGRSpatialReference system;
  system.importFromEPSG(epsg);
  system.SetAxisMappingStrategy(OAMS_TRADITIONAL_GIS_ORDER);
  return system;
}

}  // namespace

Raster::Raster(const std::string& path) {
  GDALAllRegister();
  dataset_.reset(GDALDataset::Open(path.c_str(), GDAL_OF_RASTER));
  if (!dataset_ || dataset_->GetRasterCount() < 1) Fail(path + ": GDAL reads no raster in it");
  const OGRSpatialReference* system = dataset_->GetSpatialRef();
  if (system == nullptr || dataset_->GetGeoTransform(map_.data()) != CE_None)
    Fail(path + ": lies nowhere; the contest needs a reference system and a geotransform");
  plan_ = std::make_unique<OGRSpatialReference>(*system);
  plan_->StripVertical();
  plan_->SetAxisMappingStrategy(OAMS_TRADITIONAL_GIS_ORDER);
  const OGRSpatialReference globe = SystemOf(4326);
  on_wgs84_ = plan_->IsSameGeogCS(&globe) != 0;
  if (!on_wgs84_) TakeDatumForWgs84(*plan_);
}

Raster::~Raster() = default;

Grid Raster::Heights() const {
  GDALRasterBand& band = *dataset_->GetRasterBand(1);
  const int columns = band.GetXSize(), rows = band.GetYSize();
  Grid grid{columns, rows, {}};
  grid.heights.resize(static_cast<std::size_t>(columns) * static_cast<std::size_t>(rows));
  std::vector<double> values(grid.heights.size());
  std::vector<unsigned char> mask(grid.heights.size());
  if (band.RasterIO(GF_Read, 0, 0, columns, rows, values.data(), columns, rows, GDT_Float64, 0,
                    0) != CE_None ||
      band.GetMaskBand()->RasterIO(GF_Read, 0, 0, columns, rows, mask.data(), columns, rows,
                                   GDT_Byte, 0, 0) != CE_None)
    Fail("the heights cannot be read");
  const double metres = MetresOf(band.GetUnitType()), scale = band.GetScale();
  for (std::size_t post = 0; post < values.size(); ++post) {
    const double height = (values[post] * scale + band.GetOffset()) * metres;
    grid.heights[post] = mask[post] && std::isfinite(height)
                             ? static_cast<float>(height)
                             : std::numeric_limits<float>::quiet_NaN();
  }
  return grid;
}

std::array<double, 2> Raster::CellMetres() const {
  const double column = dataset_->GetRasterXSize() / 2, row = dataset_->GetRasterYSize() / 2;
  const auto on_map = [&](double x, double y) {
    return Point{map_[0] + map_[1] * x + map_[2] * y, map_[3] + map_[4] * x + map_[5] * y, 0};
  };
  std::vector<Point> places = {on_map(column, row), on_map(column + 1, row),
                               on_map(column, row + 1)};
  Transform(*plan_, SystemOf(4978), places);
  const auto distance = [](const Point& a, const Point& b) {
    return std::hypot(a.x - b.x, a.y - b.y, a.z - b.z);
  };
  return {distance(places[0], places[1]), distance(places[0], places[2])};
}

std::string Raster::SystemToState() const {
  if (on_wgs84_) return "";
  char* text = nullptr;
  plan_->exportToWkt(&text);
  std::string wkt = text == nullptr ? "" : text;
  CPLFree(text);
  return wkt;
}

std::vector<Point> Raster::OverGrid(const std::vector<Point>& earth) const {
  std::vector<Point> points = earth;
  Transform(SystemOf(4978), SystemOf(4979), points);
  std::vector<double> heights;
  for (Point& p : points) heights.push_back(std::exchange(p.z, 0));
  Transform(SystemOf(4326), *plan_, points);
  for (std::size_t i = 0; i < points.size(); ++i) points[i].z = heights[i];
  if (plan_->IsGeographic()) {
    // Longitudes come within half a turn of the prime meridian; the raster may lie beyond.
    const double turn = 2 * std::numbers::pi / plan_->GetAngularUnits();
    const double middle = map_[0] + map_[1] * dataset_->GetRasterXSize() / 2 +
                          map_[2] * dataset_->GetRasterYSize() / 2;
    for (Point& p : points) p.x += turn * std::round((middle - p.x) / turn);
  }
  const double determinant = map_[1] * map_[5] - map_[2] * map_[4];
  for (Point& p : points) {
    const double x = p.x - map_[0], y = p.y - map_[3];
    p.x = (map_[5] * x - map_[2] * y) / determinant - 0.5;  // posts are the cells' centres
    p.y = (map_[1] * y - map_[4] * x) / determinant - 0.5;
  }
  return points;
}

}  // namespace farhorizon::peers
