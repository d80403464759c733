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
/// none. A post that no triangle uses is not part of the terrain. Nothing is stored: every question
/// is answered from the heights of the cells around.
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

  /// Third posts of the triangles on either side of `edge`; nullopt where there is none.
  /// left: on the left of a -> b in the plan (column, -row). Both empty: no edge of the terrain.
  struct Faces {
    std::optional<VertexId> left;
    std::optional<VertexId> right;
  };
  [[nodiscard]] Faces FacesOf(Edge edge) const;

  /// Every neighbour of `v` along an edge of the terrain; empty for a post that is no vertex.
  struct Neighbours {
    std::array<VertexId, 8> posts;
    int count = 0;
    [[nodiscard]] const VertexId* begin() const { return posts.data(); }
    [[nodiscard]] const VertexId* end() const { return posts.data() + count; }
  };
  [[nodiscard]] Neighbours NeighboursOf(VertexId v) const;
  [[nodiscard]] bool IsVertex(VertexId v) const { return NeighboursOf(v).count > 0; }

  /// Every edge once, by rising (a, b). Cost: O(posts).
  [[nodiscard]] std::vector<Edge> Edges() const;
  [[nodiscard]] std::int64_t CountEdges() const;

  /// Every triangle, cell by cell. Cost: O(posts).
  [[nodiscard]] std::vector<Triangle> Triangles() const;

 private:
  explicit Terrain(const Dem& dem) : dem_(&dem) {}
  [[nodiscard]] bool Has(std::int32_t column, std::int32_t row) const;
  /// FacesOf, by the triangles of the cells around.
  [[nodiscard]] Faces FacesInCells(Edge edge) const;
  /// Whether the post and all eight around it have data: the usual case, in which all is known at once.
  [[nodiscard]] bool IsSurrounded(std::int32_t column, std::int32_t row) const;

  const Dem* dem_;
};

/// Above the line through the other diagonal (1), in one plane with it (0) or below it (-1):
/// whether the edge from a to b is a ridge between the faces whose third posts are c and d.
/// Requires: c and d on opposite sides of ab in plan. Exact.
int Convexity(Point3i a, Point3i b, Point3i c, Point3i d);

}  // namespace farhorizon
