// There are two kinds of frames: stretched and moved grids, which take a few sums, and those on the
// globe, which go by way of the tile's frame and back onto the grid. In these, a height is added
// along the ellipsoid's normal and not along an axis.
#include "core/pipeline/compare/mesh_placing.h"

#include <cmath>
#include <utility>

#include "core/geo/ellipsoid_normal.h"

namespace farhorizon {

namespace {

// A point of a frame that is a stretched and moved grid.
GridPoint OnGrid(const FilePoint& p, const MeshPlacing& placing, const Dem& dem) {
  const GeoTransform& map = dem.transform;
  const double columns = dem.columns - 1;
  const double rows = dem.rows - 1;
  // Counted along the map's x, and against its y.
  const double east = (p[0] - placing.origin[0]) / placing.column_m;
  const double south = (p[1] - placing.origin[1]) / placing.row_m;
  const auto column = [&](double x) { return map.step_x > 0 ? x : columns - x; };
  const auto row = [&](double y) { return map.step_y < 0 ? y : rows - y; };
  switch (placing.frame) {
    case MeshFrame::kCrs:
      return {(p[0] - map.origin_x) / map.step_x, (p[1] - map.origin_y) / map.step_y, p[2]};
    case MeshFrame::kPosts:
      return {p[0], p[1], p[2]};
    case MeshFrame::kPostsUp:
      return {p[0], rows - p[1], p[2]};
    case MeshFrame::kCorner:
      return {column(east), row(rows - south), p[2]};
    case MeshFrame::kCornerDown:
      return {column(east), row(south), p[2]};
    case MeshFrame::kCentre:
      return {column(columns / 2 + east), row(rows / 2 - south), p[2]};
    case MeshFrame::kLonLat:
    case MeshFrame::kEcef:
    case MeshFrame::kTile:
      break;
  }
  throw InternalError("a frame on the globe is no stretched grid");
}

// The point by so much higher along the normal of the ellipsoid.
Enu Raised(const Enu& p, double height_m, const TangentFrame& frame) {
  const Enu up = EllipsoidNormal(p, frame);
  const double share = height_m / std::hypot(up.east, up.north, up.up);
  return {p.east + share * up.east, p.north + share * up.north, p.up + share * up.up};
}

Result<std::vector<Enu>> OnGlobe(const std::vector<FilePoint>& points, const MeshPlacing& placing,
                                 const TerrainInput& input) {
  if (placing.frame != MeshFrame::kLonLat) return PlaceInTileFrame(points, placing, input);
  std::vector<Geodetic> geodetic;
  geodetic.reserve(points.size());
  for (const FilePoint& point : points) {
    const FilePoint p = ZUp(point, placing.up);
    geodetic.push_back({p[0], p[1], p[2] + placing.height_offset_m});
  }
  return input.georeference().ToEnu(geodetic);
}

}  // namespace

FilePoint ZUp(const FilePoint& p, UpAxis up) {
  return up == UpAxis::kZ ? p : FilePoint{p[0], -p[2], p[1]};
}

std::array<double, 2> NominalSteps(const TerrainInput& input) {
  const Georeference& georeference = input.georeference();
  if (georeference.FullTurn() > 0) {
    return {georeference.column_step_m(), georeference.row_step_m()};
  }
  return {std::abs(input.dem().transform.step_x), std::abs(input.dem().transform.step_y)};
}

std::vector<Enu> PlaceInTileFrame(const std::vector<FilePoint>& points, const MeshPlacing& placing,
                                  const TerrainInput& input) {
  const TangentFrame& frame = input.georeference().frame();
  std::vector<Enu> placed;
  placed.reserve(points.size());
  for (const FilePoint& point : points) {
    const FilePoint p = ZUp(point, placing.up);
    const Enu at =
        placing.frame == MeshFrame::kEcef ? frame.ToEnu({p[0], p[1], p[2]}) : Enu{p[0], p[1], p[2]};
    placed.push_back(Raised(at, placing.height_offset_m, frame));
  }
  return placed;
}

Result<std::vector<GridPoint>> PlaceOnGrid(const std::vector<FilePoint>& points,
                                           const MeshPlacing& placing, const TerrainInput& input) {
  if (placing.frame == MeshFrame::kLonLat || IsStraightOnGlobe(placing.frame)) {
    Result<std::vector<Enu>> placed = OnGlobe(points, placing, input);
    if (!placed) return std::move(placed.error());
    return input.georeference().ToGrid(*placed);
  }
  std::vector<GridPoint> grid;
  grid.reserve(points.size());
  for (const FilePoint& p : points) {
    grid.push_back(OnGrid(ZUp(p, placing.up), placing, input.dem()));
    grid.back().height_m += placing.height_offset_m;
  }
  return grid;
}

}  // namespace farhorizon
