#include "core/pipeline/post_places.h"

#include <utility>

namespace farhorizon {

namespace {

// Puts into `places` the ellipsoid's normal at a point p of the local frame: at the ECEF point
// (x, y, z) of the surface it has the direction (x, y, z / (1 - e^2)), here turned into the frame.
// It is taken at p itself, not at the point of the surface below it, which turns it by less than
// e^2 times height over radius: 1e-5 at 9 km.
void PlaceNormals(const TangentFrame& frame, PostPlaces& places) {
  constexpr double kOneLessE2 = 1 - 0.00669437999014;  // WGS 84
  constexpr std::array<double, 3> kScale = {1, 1, 1 / kOneLessE2};
  const std::array<double, 16> to_ecef = frame.EnuToEcef();  // column-major
  const auto axis = [&to_ecef](std::size_t column, std::size_t k) {
    return to_ecef[4 * column + k];
  };
  for (std::size_t i = 0; i < 3; ++i) {
    places.up_at_origin[i] = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      places.up_at_origin[i] += axis(i, k) * kScale[k] * axis(3, k);
    }
    for (std::size_t j = 0; j < 3; ++j) {
      double sum = 0;
      for (std::size_t k = 0; k < 3; ++k) sum += axis(i, k) * kScale[k] * axis(j, k);
      places.up[3 * i + j] = sum;
    }
  }
}

}  // namespace

Result<PostPlaces> FindPostPlaces(const Terrain& terrain, const Georeference& georeference) {
  const Dem& dem = terrain.dem();
  PostPlaces places;
  places.column_m = georeference.column_step_m();
  places.row_m = georeference.row_step_m();
  PlaceNormals(georeference.frame(), places);
  places.positions.resize(dem.heights.size());
  std::vector<VertexId> row;
  for (std::int32_t r = 0; r < dem.rows; ++r) {
    row.clear();
    for (VertexId v = r * dem.columns; v < (r + 1) * dem.columns; ++v) {
      if (dem.HasData(v)) row.push_back(v);
    }
    Result<std::vector<Enu>> placed = georeference.ToEnu(row);
    if (!placed) return std::move(placed.error());
    for (std::size_t i = 0; i < row.size(); ++i) {
      const Enu& p = (*placed)[i];
      places.positions[static_cast<std::size_t>(row[i])] = {p.east, p.north, p.up};
    }
  }
  return places;
}

}  // namespace farhorizon
