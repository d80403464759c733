// Grid points go to map coordinates by the geotransform, from there to degrees on the ellipsoid and
// to ECEF by PROJ (core/geo/globe_transform.h), and into the local frame by a rotation
// (core/geo/frames.h); back the same way. PROJ is called for whole vectors of points.
#include "core/pipeline/georeference.h"

#include <cmath>
#include <utility>

namespace farhorizon {

namespace {

MapPoint MapPointAt(const Dem& dem, double column, double row, double height_m) {
  return {dem.transform.origin_x + column * dem.transform.step_x,
          dem.transform.origin_y + row * dem.transform.step_y, height_m};
}

double Distance(const Ecef& a, const Ecef& b) {
  return std::hypot(a.x - b.x, a.y - b.y, a.z - b.z);
}

}  // namespace

Georeference::Georeference(const Dem& dem, GlobeTransform transform, TangentFrame frame)
    : dem_(&dem), transform_(std::move(transform)), frame_(frame) {}

// Turns the frame from the tile's own axes to others. The origin is at a multiple of a power of two
// within an eighth of the diagonal: that is more than a 16th of a cell, the greatest step of a side
// (StepsOfLevel), and more than the step that kMaxLatticeBits reach over the tile with; and near
// enough to the middle for ExactInFloat.
Status Georeference::TurnTo(const FrameChoice& axes) {
  axes_ = axes;
  if (axes.axes == FrameAxes::kTile) return Ok{};
  TangentFrame common = TangentFrame::EarthFixed();
  if (axes.axes == FrameAxes::kPlace) {
    const Geodetic place = {axes.lon_deg, axes.lat_deg, 0};
    Result<std::vector<Ecef>> ecef = transform_.ToEcef({place});
    if (!ecef) return std::move(ecef.error());
    common = TangentFrame(place, ecef->front());
  }
  int exponent = 0;
  std::frexp(std::hypot(column_step_m_ * (dem_->columns - 1), row_step_m_ * (dem_->rows - 1)) / 8,
             &exponent);
  const double unit_m = std::ldexp(1.0, exponent - 1);
  const Enu middle = common.ToEnu(frame_.ToEcef({0, 0, 0}));
  const auto round = [unit_m](double x) { return std::nearbyint(x / unit_m) * unit_m; };
  frame_ = common.MovedTo({round(middle.east), round(middle.north), round(middle.up)});
  return Ok{};
}

Result<Georeference> Georeference::Of(const Terrain& terrain, GlobeOptions options,
                                      const FrameChoice& axes) {
  const Dem& dem = terrain.dem();
  // The frame's origin is the middle of the grid, on the ellipsoid; half a cell to each side gives
  // the cell's size.
  const double column = (dem.columns - 1) / 2.0;
  const double row = (dem.rows - 1) / 2.0;
  options.about = MapPointAt(dem, column, row, 0);
  Result<GlobeTransform> transform = GlobeTransform::Open(dem.crs, options);
  if (!transform) return std::move(transform.error());
  Result<std::vector<Geodetic>> middle = transform->ToGeodetic(
      {MapPointAt(dem, column, row, 0), MapPointAt(dem, column - 0.5, row, 0),
       MapPointAt(dem, column + 0.5, row, 0), MapPointAt(dem, column, row - 0.5, 0),
       MapPointAt(dem, column, row + 0.5, 0)});
  if (!middle) return std::move(middle.error());
  Geodetic origin = (*middle)[0];
  origin.height_m = 0;
  (*middle)[0] = origin;
  Result<std::vector<Ecef>> ecef = transform->ToEcef(*middle);
  if (!ecef) return std::move(ecef.error());
  Georeference georeference(dem, *std::move(transform), TangentFrame(origin, (*ecef)[0]));
  georeference.column_step_m_ = Distance((*ecef)[1], (*ecef)[2]);
  georeference.row_step_m_ = Distance((*ecef)[3], (*ecef)[4]);
  georeference.middle_ = origin;
  if (Status turned = georeference.TurnTo(axes); !turned) return std::move(turned.error());
  return georeference;
}

bool Georeference::KeepsOrientation() const {
  return (dem_->transform.step_x > 0) == (dem_->transform.step_y < 0);
}

Result<std::vector<Geodetic>> Georeference::ToGeodetic(const std::vector<VertexId>& posts) const {
  std::vector<MapPoint> points;
  points.reserve(posts.size());
  for (const VertexId v : posts) {
    points.push_back(MapPointAt(*dem_, dem_->Column(v), dem_->Row(v), dem_->HeightM(v)));
  }
  return transform_.ToGeodetic(points);
}

Result<std::vector<Geodetic>> Georeference::ToGeodetic(const std::vector<GridPoint>& points) const {
  std::vector<MapPoint> map;
  map.reserve(points.size());
  for (const GridPoint& p : points) {
    map.push_back(MapPointAt(*dem_, p.column, p.row, p.height_m));
  }
  return transform_.ToGeodetic(map);
}

Result<std::vector<Enu>> Georeference::ToEnu(const std::vector<Geodetic>& points) const {
  Result<std::vector<Ecef>> ecef = transform_.ToEcef(points);
  if (!ecef) return std::move(ecef.error());
  std::vector<Enu> enu;
  enu.reserve(ecef->size());
  for (const Ecef& p : *ecef) enu.push_back(frame_.ToEnu(p));
  return enu;
}

Result<std::vector<Enu>> Georeference::ToEnu(const std::vector<VertexId>& posts) const {
  Result<std::vector<Geodetic>> geodetic = ToGeodetic(posts);
  if (!geodetic) return std::move(geodetic.error());
  return ToEnu(*geodetic);
}

Result<std::vector<Geodetic>> Georeference::ToGeodetic(const std::vector<Enu>& points) const {
  std::vector<Ecef> ecef;
  ecef.reserve(points.size());
  for (const Enu& p : points) ecef.push_back(frame_.ToEcef(p));
  return transform_.FromEcef(ecef);
}

Result<std::vector<GridPoint>> Georeference::ToGrid(const std::vector<Enu>& points) const {
  Result<std::vector<Geodetic>> geodetic = ToGeodetic(points);
  if (!geodetic) return std::move(geodetic.error());
  Result<std::vector<MapPoint>> map = transform_.FromGeodetic(*geodetic);
  if (!map) return std::move(map.error());
  std::vector<GridPoint> grid;
  grid.reserve(map->size());
  for (const MapPoint& p : *map) {
    grid.push_back({(p.x - dem_->transform.origin_x) / dem_->transform.step_x,
                    (p.y - dem_->transform.origin_y) / dem_->transform.step_y, p.z});
  }
  return grid;
}

Result<std::vector<GroundStep>> Georeference::StepsAt(
    const std::vector<std::array<double, 2>>& points) const {
  // The point itself, and half a step to each of its four sides.
  constexpr std::size_t kEach = 5;
  std::vector<MapPoint> around;
  around.reserve(points.size() * kEach);
  for (const auto& [column, row] : points) {
    around.push_back(MapPointAt(*dem_, column, row, 0));
    around.push_back(MapPointAt(*dem_, column - 0.5, row, 0));
    around.push_back(MapPointAt(*dem_, column + 0.5, row, 0));
    around.push_back(MapPointAt(*dem_, column, row - 0.5, 0));
    around.push_back(MapPointAt(*dem_, column, row + 0.5, 0));
  }
  Result<std::vector<Geodetic>> geodetic = transform_.ToGeodetic(around);
  if (!geodetic) return std::move(geodetic.error());
  for (Geodetic& g : *geodetic) g.height_m = 0;
  Result<std::vector<Ecef>> ecef = transform_.ToEcef(*geodetic);
  if (!ecef) return std::move(ecef.error());
  std::vector<GroundStep> steps;
  steps.reserve(points.size());
  for (std::size_t i = 0; i < points.size(); ++i) {
    const std::size_t at = i * kEach;
    const TangentFrame here((*geodetic)[at], (*ecef)[at]);
    const Enu west = here.ToEnu((*ecef)[at + 1]);
    const Enu east = here.ToEnu((*ecef)[at + 2]);
    const Enu north = here.ToEnu((*ecef)[at + 3]);
    const Enu south = here.ToEnu((*ecef)[at + 4]);
    steps.push_back({east.east - west.east, east.north - west.north, south.east - north.east,
                     south.north - north.north});
  }
  return steps;
}

}  // namespace farhorizon
