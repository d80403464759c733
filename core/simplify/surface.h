#pragma once

#include <cstdint>
#include <vector>

#include "core/terrain/terrain.h"

namespace farhorizon {

/// A triangle of a Surface, by its index in Terrain::Triangles().
using TriangleId = std::int32_t;

/// A triangulated surface over posts that loses vertices by half-edge collapses and gains none.
///
/// The corners of a vertex's triangles form a linked list, so a collapse allocates nothing and fans
/// that share only a post need no special case. An edge vanishes only with one of its posts, and a
/// post that is gone does not come back: while both posts of an edge are vertices, it is an edge.
/// Memory: 4 bytes a post, 24 a triangle of the terrain.
class Surface {
 public:
  explicit Surface(const Terrain& terrain);

  /// Calls visit(t, w, x) for each triangle (v, w, x) around `v`, counter-clockwise, in no order.
  template <typename Visit>
  void ForEachTriangleOf(VertexId v, Visit visit) const {
    for (Corner c = first_corner_[Index(v)]; c != kNone; c = next_corner_[Index(c)]) {
      const TriangleId t = c / 3;
      const std::int32_t k = c % 3;
      visit(t, At(t, (k + 1) % 3), At(t, (k + 2) % 3));
    }
  }

  [[nodiscard]] bool IsVertex(VertexId v) const { return first_corner_[Index(v)] != kNone; }
  [[nodiscard]] std::int32_t CountTrianglesOf(VertexId v) const;
  [[nodiscard]] std::int64_t triangle_count() const { return triangle_count_; }
  /// Ids are below this; those of triangles that are gone are not used again.
  [[nodiscard]] TriangleId triangle_id_end() const {
    return static_cast<TriangleId>(corners_.size() / 3);
  }
  [[nodiscard]] Triangle triangle(TriangleId t) const { return {At(t, 0), At(t, 1), At(t, 2)}; }

  /// Moves `v` onto its neighbour `b`: triangles with both vanish, the others of `v` become `b`'s.
  /// Requires: no triangle flips.
  void Collapse(VertexId v, VertexId b);

  /// The triangles that are left, in ascending order of id.
  [[nodiscard]] std::vector<Triangle> Triangles() const;

 private:
  using Corner = std::int32_t;  // 3 * triangle + 0, 1 or 2
  static constexpr std::int32_t kNone = -1;

  template <typename Id>
  static std::size_t Index(Id id) {
    return static_cast<std::size_t>(id);
  }
  [[nodiscard]] VertexId At(TriangleId t, std::int32_t k) const {
    return corners_[Index(3 * t + k)];
  }
  void Chain(VertexId v, Corner c);
  void Unchain(VertexId v, Corner c);

  std::vector<VertexId> corners_;     // per corner; a triangle that is gone has -1 at its first
  std::vector<Corner> next_corner_;   // per corner: another of the same vertex
  std::vector<Corner> first_corner_;  // per post
  std::int64_t triangle_count_ = 0;
};

}  // namespace farhorizon
