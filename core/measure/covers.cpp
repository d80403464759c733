// In the plane, over the posts: triangles that all turn one way, whose areas add up to the domain's
// and whose outline is the domain's, cover it once. Areas are whole numbers there, and their sum is
// exact; the displaced vertices themselves need only turn the same way.
#include "core/measure/covers.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "core/geometry/plan.h"
#include "core/measure/mesh_sides.h"
#include "core/terrain/border.h"

namespace farhorizon {

namespace {

// Columns or rows. A vertex further from its post may be nearer to another one.
constexpr double kMostDisplacement = 0.5;

Error BadMesh(const std::string& what, ErrorKind kind) {
  return Error{ErrorCode::kUnsupportedData, what, kind};
}

Status CheckPosts(const Terrain& terrain, const GridMesh& mesh,
                  const std::vector<VertexId>& posts) {
  if (posts.size() != mesh.points.size()) {
    return BadMesh("the mesh has " + std::to_string(mesh.points.size()) + " points but " +
                       std::to_string(posts.size()) + " posts are named for them",
                   "unnamed-points");
  }
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
  }
  return Ok{};
}

// The mesh's triangles by posts, over the posts of the terrain, or the reason why they do not cover
// the terrain's domain. Triangles that all turn counter-clockwise cover it once if their areas add
// up to the domain's and their outline is on the domain's (CheckCovers checks that).
Result<GridMesh> MeshOverPosts(const Terrain& terrain, const GridMesh& mesh,
                               const std::vector<VertexId>& posts) {
  GridMesh over_posts;
  over_posts.points.resize(static_cast<std::size_t>(terrain.post_count()));
  over_posts.triangles.reserve(mesh.triangles.size());
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
    over_posts.triangles.push_back(over);
  }
  std::int64_t whole = 0;  // twice the area of a triangle of the terrain is 1
  for (std::int32_t row = 0; row + 1 < terrain.dem().rows; ++row) {
    for (std::int32_t column = 0; column + 1 < terrain.dem().columns; ++column) {
      whole += terrain.Cell(column, row).count;
    }
  }
  if (covered != whole) {
    return BadMesh("the mesh covers " + std::to_string(static_cast<double>(covered) / 2) + " of " +
                       std::to_string(static_cast<double>(whole) / 2) + " cells",
                   "hole");
  }
  return over_posts;
}

}  // namespace

Status CheckCovers(const Terrain& terrain, const GridMesh& mesh,
                   const std::vector<VertexId>& posts) {
  Status near_posts = CheckPosts(terrain, mesh, posts);
  if (!near_posts) return near_posts;
  // By posts: one that two vertices stand for is one point of the surface.
  Result<GridMesh> over_posts = MeshOverPosts(terrain, mesh, posts);
  if (!over_posts) return std::move(over_posts.error());
  const MeshSides sides = SidesOf(*over_posts);
  if (sides.crowded > 0)
    return BadMesh("two triangles of the mesh lie over one another", "overlap");
  for (const MeshSide& side : sides.sides) {
    if (!side.IsOutline()) continue;
    const Edge edge{side.a, side.b};
    if (!RunsAlongOutline(terrain, edge)) {
      return BadMesh("the mesh ends between posts " + std::to_string(edge.a) + " and " +
                         std::to_string(edge.b) + ", where the terrain goes on or has no edge",
                     "hole");
    }
  }
  return Ok{};
}

}  // namespace farhorizon
