// Three steps. The mesh is checked: its points are near their posts, its triangles over the posts
// cover the terrain's domain once and end where the terrain ends. Its vertical error and the rms of
// its silhouette error are measured on the mesh as it is. The silhouette bound is proven for the
// mesh over the posts, and what the vertices' displacement can add is added.
// Cost: that of VerticalError, RmsOverLines and SilhouetteBound; the rest is O(n log n).
#include "core/measure/mesh_error.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "core/geometry/plan.h"
#include "core/measure/line_sampling.h"
#include "core/measure/mesh_edges.h"
#include "core/measure/silhouette_bound.h"
#include "core/measure/vertical_error.h"
#include "core/terrain/border.h"

namespace farhorizon {

namespace {

// Columns or rows. A vertex further from its post may be nearer to another one.
constexpr double kMostDisplacement = 0.5;

Error BadMesh(const std::string& what, ErrorKind kind) {
  return Error{ErrorCode::kUnsupportedData, what, kind};
}

// The greatest distances of vertices from their posts.
struct Displacement {
  double greatest = 0;   // in plan, columns or rows
  double by_column = 0;  // along each axis, columns or rows
  double by_row = 0;
  double greatest_m = 0;  // in height
};

Result<Displacement> MeasureDisplacement(const Terrain& terrain, const GridMesh& mesh,
                                         const std::vector<VertexId>& posts) {
  if (posts.size() != mesh.points.size()) {
    return BadMesh("the mesh has " + std::to_string(mesh.points.size()) + " points but " +
                       std::to_string(posts.size()) + " posts are named for them",
                   "unnamed-points");
  }
  Displacement displacement;
  for (std::size_t i = 0; i < posts.size(); ++i) {
    const VertexId v = posts[i];
    if (v < 0 || v >= terrain.post_count() || !terrain.dem().HasData(v)) {
      return BadMesh("point " + std::to_string(i) + " stands for post " + std::to_string(v) +
                         ", which the DEM does not have",
                     "unknown-post");
    }
    const GridPoint& p = mesh.points[i];
    const double off = std::hypot(p.column - terrain.dem().Column(v), p.row - terrain.dem().Row(v));
    if (!(off <= kMostDisplacement)) {
      return BadMesh("point " + std::to_string(i) + " is " + std::to_string(off) +
                         " cells away from its post; half a cell is the most that can be measured",
                     "displaced-vertex");
    }
    displacement.greatest = std::max(displacement.greatest, off);
    displacement.by_column =
        std::max(displacement.by_column, std::abs(p.column - terrain.dem().Column(v)));
    displacement.by_row = std::max(displacement.by_row, std::abs(p.row - terrain.dem().Row(v)));
    displacement.greatest_m =
        std::max(displacement.greatest_m, std::abs(p.height_m - terrain.dem().HeightM(v)));
  }
  return displacement;
}

// The mesh's triangles over posts, or the reason why they do not cover the terrain's domain.
// Triangles that all turn counter-clockwise cover it once if their areas add up to the domain's and
// their outline is on the domain's (MeasureMeshError checks that).
Result<std::vector<Triangle>> TrianglesOverPosts(const Terrain& terrain, const GridMesh& mesh,
                                                 const std::vector<VertexId>& posts) {
  std::vector<Triangle> triangles;
  triangles.reserve(mesh.triangles.size());
  std::int64_t covered = 0;
  const auto count = static_cast<std::int32_t>(posts.size());
  for (const std::array<std::int32_t, 3>& t : mesh.triangles) {
    if (std::any_of(t.begin(), t.end(), [&](std::int32_t i) { return i < 0 || i >= count; })) {
      return BadMesh("a triangle names a point that the mesh does not have", "unknown-point");
    }
    const auto point = [&](std::size_t k) { return mesh.points[static_cast<std::size_t>(t[k])]; };
    const GridPoint a = point(0);
    const GridPoint b = point(1);
    const GridPoint c = point(2);
    const double turn =
        (b.row - a.row) * (c.column - a.column) - (b.column - a.column) * (c.row - a.row);
    const auto post = [&](std::size_t k) { return posts[static_cast<std::size_t>(t[k])]; };
    const Triangle over = {post(0), post(1), post(2)};
    const std::int64_t area =
        TwiceArea(terrain.Point(over[0]), terrain.Point(over[1]), terrain.Point(over[2]));
    if (area <= 0 || !(turn > 0)) {
      return BadMesh("a triangle at post " + std::to_string(over[0]) +
                         " is flipped or flat in plan; use a finer quantisation",
                     "flipped-triangle");
    }
    covered += area;
    triangles.push_back(over);
  }
  std::int64_t whole = 0;
  for (const Triangle& t : terrain.Triangles()) {
    whole += TwiceArea(terrain.Point(t[0]), terrain.Point(t[1]), terrain.Point(t[2]));
  }
  if (covered != whole) {
    return BadMesh("the mesh covers " + std::to_string(static_cast<double>(covered) / 2) + " of " +
                       std::to_string(static_cast<double>(whole) / 2) + " cells",
                   "hole");
  }
  return triangles;
}

// The greatest change of height over a fixed point of the plan that moving the vertices within the
// plan can cause, metres: over all triangles over posts, slope times displacement, axis by axis.
double HeightChange(const Terrain& terrain, const std::vector<Triangle>& triangles,
                    const Displacement& displacement) {
  double most = 0;
  for (const Triangle& t : triangles) {
    const Slope slope = SlopeOf(terrain.Point(t[0]), terrain.Point(t[1]), terrain.Point(t[2]));
    most = std::max(most,
                    slope.by_column * displacement.by_column + slope.by_row * displacement.by_row);
  }
  return most * terrain.dem().quantum_m;
}

std::vector<GridSegment> SkylineOf(const Terrain& terrain, const Horizon& horizon) {
  const auto point = [&terrain](VertexId v) {
    const Dem& dem = terrain.dem();
    return GridPoint{static_cast<double>(dem.Column(v)), static_cast<double>(dem.Row(v)),
                     dem.HeightM(v)};
  };
  std::vector<GridSegment> segments;
  segments.reserve(horizon.edges.size());
  for (const HorizonEdge& h : horizon.edges) {
    segments.push_back({point(h.edge.a), point(h.edge.b)});
  }
  return segments;
}

// Every edge of the mesh once, not its ridges only: an edge may have become a ridge when vertices
// moved.
std::vector<GridSegment> SidesOf(const GridMesh& mesh) {
  std::vector<std::pair<std::int32_t, std::int32_t>> sides;
  sides.reserve(mesh.triangles.size() * 3);
  for (const std::array<std::int32_t, 3>& t : mesh.triangles) {
    for (std::size_t k = 0; k < 3; ++k) sides.push_back(std::minmax(t[k], t[(k + 1) % 3]));
  }
  std::sort(sides.begin(), sides.end());
  sides.erase(std::unique(sides.begin(), sides.end()), sides.end());
  std::vector<GridSegment> segments;
  segments.reserve(sides.size());
  for (const auto& [i, j] : sides) {
    segments.push_back(
        {mesh.points[static_cast<std::size_t>(i)], mesh.points[static_cast<std::size_t>(j)]});
  }
  return segments;
}

}  // namespace

Result<MeshError> MeasureMeshError(const Terrain& terrain, const Horizon& horizon,
                                   const GridMesh& mesh, const std::vector<VertexId>& posts,
                                   double asked_m, const RunControl& control) {
  control.Report(Stage::kMeasure, 0);
  Result<Displacement> displacement = MeasureDisplacement(terrain, mesh, posts);
  if (!displacement) return std::move(displacement.error());
  Result<std::vector<Triangle>> triangles = TrianglesOverPosts(terrain, mesh, posts);
  if (!triangles) return std::move(triangles.error());
  const std::optional<std::vector<MeshEdge>> edges = EdgesOf(*triangles);
  if (!edges) return BadMesh("two triangles of the mesh lie over one another", "overlap");

  for (const MeshEdge& e : *edges) {
    if (e.left && e.right) continue;
    if (!RunsAlongOutline(terrain, e.edge)) {
      return BadMesh("the mesh ends between posts " + std::to_string(e.edge.a) + " and " +
                         std::to_string(e.edge.b) + ", where the terrain goes on or has no edge",
                     "hole");
    }
  }

  MeshError error;
  error.displacement = displacement->greatest;
  error.vertical = VerticalError(terrain, mesh);
  control.Report(Stage::kMeasure, 0.05);
  error.silhouette.rms_m = RmsOverLines(SkylineOf(terrain, horizon), SidesOf(mesh),
                                        terrain.dem().columns, terrain.dem().rows);
  control.Report(Stage::kMeasure, 0.45);
  const double quantum = terrain.dem().quantum_m;
  // A point of the mesh is at most `by_column`, `by_row` in plan and `greatest_m` in height away
  // from its counterpart on the mesh over posts. On the way in plan the height of that mesh changes
  // by no more than slope times distance.
  const double lost_m = displacement->greatest_m + HeightChange(terrain, *triangles, *displacement);
  Result<double> bound =
      SilhouetteBound(terrain, horizon, *edges, (asked_m - lost_m) / quantum, control);
  if (!bound) return std::move(bound.error());
  error.silhouette.max_m = *bound * quantum + lost_m;
  control.Report(Stage::kMeasure, 1.0);
  return error;
}

}  // namespace farhorizon
