#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "core/base/result.h"
#include "core/geometry/point.h"
#include "core/terrain/dem.h"
#include "core/terrain/mesh.h"

namespace farhorizon {

/// The triangulated surface over a DEM, borders and holes included.
///
/// Each cell of four posts is split along the diagonal from (column, row) to (column + 1, row + 1);
/// a cell with one post without data keeps the triangle of its other three; a cell with more has
/// none. A post that no triangle uses is not part of the terrain. No topology is stored: each query
/// reads the heights of the cells around.
///
///   (c, r) o-----o (c + 1, r)         the plan as a map has it: columns to the right,
///          | \   |                    rows downwards
///          |   \ |
///          o-----o (c + 1, r + 1)
///
/// Threads: safe to read from several.
class Terrain {
 public:
  /// Requires: `dem` outlives the terrain.
  /// Errors: kUnsupportedData where no three posts make a triangle.
  static Result<Terrain> Build(const Dem& dem);

  [[nodiscard]] const Dem& dem() const { return *dem_; }
  [[nodiscard]] VertexId post_count() const { return dem_->columns * dem_->rows; }
  [[nodiscard]] Point3i Point(VertexId v) const {
    return {dem_->Column(v), dem_->Row(v), dem_->heights[static_cast<std::size_t>(v)]};
  }

  /// The triangles of the cell whose first corner is (column, row): none, one or two.
  struct CellTriangles {
    std::array<Triangle, 2> triangles;
    int count = 0;
  };
  [[nodiscard]] CellTriangles Cell(std::int32_t column, std::int32_t row) const;

  /// Third posts of the triangles on either side of an edge; nullopt where there is none.
  /// left: on the left of a -> b in the plan (column, -row). Both empty: no edge of the terrain.
  struct Faces {
    std::optional<VertexId> left;
    std::optional<VertexId> right;
  };
  [[nodiscard]] Faces FacesOf(Edge edge) const;

  /// Whether `edge` is a border edge, or a ridge: its faces bend downwards. On any line across
  /// another edge, ground beside that edge is at least as high. Exact.
  /// faces: those of `edge`, in the terrain or in another triangulation of posts.
  [[nodiscard]] bool IsRidgeOrBorder(Edge edge, const Faces& faces) const;
  [[nodiscard]] bool IsRidgeOrBorder(Edge edge) const {
    return IsRidgeOrBorder(edge, FacesOf(edge));
  }

  /// Every neighbour of `v` along an edge of the terrain; none for a post that is not a vertex.
  struct Neighbours {
    std::array<VertexId, 8> posts;
    int count = 0;
    [[nodiscard]] const VertexId* begin() const { return posts.data(); }
    [[nodiscard]] const VertexId* end() const { return posts.data() + count; }
  };
  [[nodiscard]] Neighbours NeighboursOf(VertexId v) const;
  [[nodiscard]] bool IsVertex(VertexId v) const { return NeighboursOf(v).count > 0; }

  /// Every edge once, in ascending order of (a, b). Cost: O(posts).
  [[nodiscard]] std::vector<Edge> Edges() const;
  [[nodiscard]] std::int64_t CountEdges() const;

  /// Every triangle, cell by cell. Cost: O(posts).
  [[nodiscard]] std::vector<Triangle> Triangles() const;

 private:
  explicit Terrain(const Dem& dem) : dem_(&dem) {}
  [[nodiscard]] bool Has(std::int32_t column, std::int32_t row) const;
  /// FacesOf, from the triangles of the cells that have both posts: correct everywhere.
  [[nodiscard]] Faces FacesInCells(Edge edge) const;
  /// Whether the post and all eight around it have data: the usual case, in which every cell around
  /// it has two triangles.
  [[nodiscard]] bool IsSurrounded(std::int32_t column, std::int32_t row) const;

  const Dem* dem_;
};

}  // namespace farhorizon
