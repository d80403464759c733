// The order matters: skirts go before triangles are turned, for they have no side in plan; heights
// are looked up before anything is measured, so that a mesh that lies elsewhere is refused with its
// cause and not measured.
#include "core/pipeline/compare/prepared_mesh.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "core/pipeline/compare/covered_part.h"
#include "core/pipeline/compare/height_agreement.h"
#include "core/pipeline/compare/mesh_over_posts.h"

namespace farhorizon {

namespace {

// Below this, a mesh that should follow the DEM has errors as large as the relief.
constexpr double kHardlyFollows = 0.5;

std::vector<std::array<std::int32_t, 3>> Signed(
    const std::vector<std::array<std::uint32_t, 3>>& triangles) {
  std::vector<std::array<std::int32_t, 3>> result;
  result.reserve(triangles.size());
  for (const auto& [a, b, c] : triangles) {
    result.push_back(
        {static_cast<std::int32_t>(a), static_cast<std::int32_t>(b), static_cast<std::int32_t>(c)});
  }
  return result;
}

// Counts what the heights over the posts tell, and checks that they can be the DEM's.
Status Describe(const std::vector<double>& heights, const TerrainInput& input,
                MeshComparison& about, const RunControl& control) {
  const Dem& dem = input.dem();
  std::int64_t with_data = 0;
  for (VertexId v = 0; v < dem.columns * dem.rows; ++v) {
    const bool covered = !std::isnan(heights[static_cast<std::size_t>(v)]);
    with_data += dem.HasData(v) ? 1 : 0;
    about.posts_without_data += covered && !dem.HasData(v) ? 1 : 0;
  }
  const HeightAgreement agreement = CompareHeights(heights, dem);
  if (agreement.posts == 0) {
    return Error{ErrorCode::kUnsupportedData, "the mesh covers no post of the DEM with data",
                 "mesh-elsewhere"};
  }
  about.posts = agreement.posts;
  about.covered_share = static_cast<double>(agreement.posts) / static_cast<double>(with_data);
  about.hole_posts = CountHolePosts(heights, dem);
  about.mean_error_m = agreement.mean_m;
  about.correlation = agreement.correlation;
  if (Status lies = CheckHeights(agreement, input); !lies) return lies;
  const bool relief = input.report().heights_m[1] > input.report().heights_m[0];
  if (relief && agreement.correlation < kHardlyFollows) {
    control.Warn("the mesh's heights hardly follow the DEM's (correlation " +
                 std::to_string(agreement.correlation) +
                 "): is it a mesh of this DEM, and not mirrored?");
  }
  return Ok{};
}

}  // namespace

Result<PreparedMesh> PrepareMesh(const FileMesh& file, const StatedPlacing& stated,
                                 const TerrainInput& input, MeshComparison& about,
                                 const RunControl& control) {
  Result<ChosenPlacing> chosen = ChoosePlacing(file, stated, input);
  if (!chosen) return std::move(chosen.error());
  about.placing = chosen->text;
  about.triangles = static_cast<std::int64_t>(file.triangles.size());
  about.vertices = static_cast<std::int64_t>(file.points.size());
  about.polygons = file.polygons;
  PreparedMesh prepared;
  prepared.placing = chosen->placing;
  prepared.assumed = chosen->assumed;
  GridMesh& grid = prepared.mesh.grid;
  Result<std::vector<GridPoint>> points = PlaceOnGrid(file.points, chosen->placing, input);
  if (!points) return std::move(points.error());
  grid.points = *std::move(points);
  grid.triangles = Signed(file.triangles);
  if (IsStraightOnGlobe(chosen->placing.frame)) {
    for (const Enu& p : PlaceInTileFrame(file.points, chosen->placing, input)) {
      prepared.mesh.straight.push_back({p.east, p.north, p.up});
    }
  }
  const Georeference& georeference = input.georeference();
  about.skirt_triangles =
      DropSkirts(grid, std::min(georeference.column_step_m(), georeference.row_step_m()));
  about.turned = TurnCounterClockwise(grid);
  Result<std::vector<double>> heights = HeightsOverPosts(grid, input.dem());
  if (!heights) return std::move(heights.error());
  prepared.heights = *std::move(heights);
  if (Status lies = Describe(prepared.heights, input, about, control); !lies) {
    return std::move(lies.error());
  }
  return prepared;
}

}  // namespace farhorizon
