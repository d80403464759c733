#include "core/pipeline/compare/post_places.h"

#include <array>
#include <utility>

#include "core/geo/ellipsoid_normal.h"

namespace farhorizon {

namespace {

void SetVerticals(const TangentFrame& frame, PostPlaces& places) {
  // The normal is linear in the point: its value at the origin, and what each axis adds.
  const auto normal = [&frame](const Enu& p) -> std::array<double, 3> {
    const Enu up = EllipsoidNormal(p, frame);
    return {up.east, up.north, up.up};
  };
  // Over the length of the earth's radius, so that differences lose no digits.
  constexpr double kStep = 6e6;
  places.up_at_origin = normal({0, 0, 0});
  const std::array<std::array<double, 3>, 3> ends = {normal({kStep, 0, 0}), normal({0, kStep, 0}),
                                                     normal({0, 0, kStep})};
  for (std::size_t row = 0; row < 3; ++row) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      places.up[3 * row + axis] = (ends[axis][row] - places.up_at_origin[row]) / kStep;
    }
  }
}

}  // namespace

Result<PostPlaces> PlacesFor(MeshFrame frame, const TerrainInput& input, const CoveredPart* part) {
  PostPlaces places;
  places.column_m = input.georeference().column_step_m();
  places.row_m = input.georeference().row_step_m();
  if (!IsStraightOnGlobe(frame)) return places;
  const Dem& whole = input.dem();
  const Dem& dem = part == nullptr ? whole : part->dem;
  const std::array<std::int32_t, 2> first =
      part == nullptr ? std::array<std::int32_t, 2>{0, 0} : part->first;
  places.positions.resize(dem.heights.size());
  std::vector<VertexId> row;
  std::vector<std::size_t> at;
  for (VertexId v = 0; v < dem.columns * dem.rows; ++v) {
    if (dem.HasData(v)) {
      at.push_back(static_cast<std::size_t>(v));
      row.push_back((dem.Row(v) + first[1]) * whole.columns + dem.Column(v) + first[0]);
    }
    if (dem.Column(v) + 1 < dem.columns || row.empty()) continue;
    Result<std::vector<Enu>> points = input.georeference().ToEnu(row);
    if (!points) return std::move(points.error());
    for (std::size_t i = 0; i < at.size(); ++i) {
      const Enu& p = (*points)[i];
      places.positions[at[i]] = {p.east, p.north, p.up};
    }
    row.clear();
    at.clear();
  }
  SetVerticals(input.georeference().frame(), places);
  return places;
}

}  // namespace farhorizon
