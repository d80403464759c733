#include "core/simplify/mesh_error.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "core/simplify/border.h"
#include "core/simplify/line_sampling.h"
#include "core/simplify/mesh_edges.h"
#include "core/simplify/plan.h"
#include "core/simplify/silhouette_bound.h"
#include "core/simplify/vertical_error.h"

namespace farhorizon {
namespace {

constexpr double kMostDisplacement =
    0.5;  // columns or rows: past it a vertex is nearer another post

Error BadMesh(const std::string& what, ErrorKind kind) {
  return Error{ErrorCode::kUnsupportedData, what, kind};
}

/// What moving the vertices from their posts has done.
struct Displacement {
  double greatest = 0;   ///< in plan, columns or rows
  double by_column = 0;  ///< along each axis, columns or rows
  double by_row = 0;
  double greatest_m = 0;  ///< in height
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

/// The mesh's triangles over posts, or what keeps it from covering the terrain's domain.
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

/// What moving the vertices along the grid does to the height over a fixed place, metres: the most on
/// any triangle over posts.
double HeightLost(const Terrain& terrain, const std::vector<Triangle>& triangles,
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

/// Every side of the mesh once: which of them are ridges may have changed with the vertices.
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
                                   double asked_m, const Watch& watch) {
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
  watch.Report("measure", 0.2);
  error.silhouette.rms_m = RmsOverLines(SkylineOf(terrain, horizon), SidesOf(mesh),
                                        terrain.dem().columns, terrain.dem().rows);
  watch.Report("measure", 0.4);
  const double quantum = terrain.dem().quantum_m;
  // A point of the mesh is at most `by_column`, `by_row` in plan and `greatest_m` in height away from
  // its place on the mesh over posts, whose height changes by no more than its slopes on the way.
  const double lost_m = displacement->greatest_m + HeightLost(terrain, *triangles, *displacement);
  Result<double> bound =
      SilhouetteBound(terrain, horizon, *edges, (asked_m - lost_m) / quantum, watch);
  if (!bound) return std::move(bound.error());
  error.silhouette.max_m = *bound * quantum + lost_m;
  watch.Report("measure", 1.0);
  return error;
}

}  // namespace farhorizon
