#include "core/pipeline/compare/draw_comparison.h"

#include <limits>
#include <utility>

#include "core/pipeline/compare/compare_picture.h"
#include "core/pipeline/compare/mesh_over_posts.h"

namespace farhorizon {

namespace {

// Of mesh less DEM at the posts, in the frame in which the mesh is straight; NaN where either has
// nothing. On the globe heights are those above the tangent plane, which differ from the vertical
// by its tilt: by less than a thousandth within a degree.
Result<std::vector<double>> ErrorsAtPosts(const ComparedMesh& compared) {
  const Dem& dem = compared.terrain.dem();
  GridMesh mesh = compared.mesh.grid;
  for (std::size_t i = 0; i < compared.mesh.straight.size(); ++i) {
    mesh.points[i].height_m = compared.mesh.straight[i][2];
  }
  Result<std::vector<double>> errors = HeightsOverPosts(mesh, dem);
  if (!errors) return errors;
  const bool on_globe = !compared.places.positions.empty();
  for (VertexId v = 0; v < dem.columns * dem.rows; ++v) {
    const auto i = static_cast<std::size_t>(v);
    (*errors)[i] -= !dem.HasData(v) ? std::numeric_limits<double>::quiet_NaN()
                    : on_globe      ? compared.places.positions[i][2]
                                    : dem.HeightM(v);
  }
  return errors;
}

}  // namespace

Result<std::string> DrawComparison(const ComparedMesh& compared) {
  Result<std::vector<double>> errors = ErrorsAtPosts(compared);
  if (!errors) return std::move(errors.error());
  Result<std::vector<SkylinePair>> skylines =
      SkylinePairs(compared.input, compared.terrain, compared.horizon, compared.mesh.grid);
  if (!skylines) return std::move(skylines.error());
  const double aspect = compared.places.column_m / compared.places.row_m;
  return DrawComparisonSvg({.title = compared.title,
                            .lines = compared.lines,
                            .skylines = *std::move(skylines),
                            .map = MapOf(*errors, compared.terrain.dem(), aspect)});
}

}  // namespace farhorizon
