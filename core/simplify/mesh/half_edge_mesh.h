#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "core/simplify/mesh/ground.h"
#include "core/simplify/mesh/ring.h"
#include "core/simplify/mesh/squares.h"
#include "core/simplify/mesh/table.h"

namespace farhorizon {

/// A triangulation over posts that loses vertices and turns edges: half-edges in arrays.
///
/// Half-edge h is a side of triangle h / 3, from origin(h) to origin(Next(h)). Triangles turn from
/// columns to rows (Turn > 0). A vertex keeps its id, the post where it began, when it is moved.
/// Invariants: every triangle is sound, except what CutOff may leave; together they cover the
/// terrain's domain once; twin(twin(h)) == h.
/// A post at which fans meet without a shared edge is `knotted`: it must stay as it is.
/// Memory: 77 bytes a post at first.
class HalfEdgeMesh {
 public:
  static constexpr std::int32_t kNone = -1;

  /// All triangles of the ground's terrain. Requires: `ground` outlives the mesh.
  explicit HalfEdgeMesh(const Ground& ground);

  static std::int32_t Next(std::int32_t h) { return h % 3 == 2 ? h - 2 : h + 1; }
  static std::int32_t Previous(std::int32_t h) { return h % 3 == 0 ? h + 2 : h - 1; }
  [[nodiscard]] std::int32_t origin(std::int32_t h) const { return origin_[h]; }
  [[nodiscard]] std::int32_t twin(std::int32_t h) const { return twin_[h]; }
  [[nodiscard]] std::int32_t half_edges() const { return origin_.size(); }
  [[nodiscard]] std::int32_t vertices() const { return out_.size(); }
  [[nodiscard]] std::int32_t triangles() const { return triangles_; }
  [[nodiscard]] std::int32_t degree(std::int32_t v) const { return degree_[v]; }

  [[nodiscard]] bool IsVertex(std::int32_t v) const { return out_[v] != kNone; }
  [[nodiscard]] bool IsKnotted(std::int32_t v) const { return degree_[v] == kKnotted; }
  [[nodiscard]] bool OnRim(std::int32_t v) const { return twin_[out_[v]] == kNone; }
  [[nodiscard]] bool Stands(std::int32_t triangle) const { return origin_[3 * triangle] >= 0; }
  [[nodiscard]] const Place& at(std::int32_t v) const { return at_[v]; }
  [[nodiscard]] float squares(std::int32_t triangle) const { return squares_[triangle]; }
  [[nodiscard]] const Ground& ground() const { return *ground_; }
  /// How posts are measured against triangles. After a change of it, MeasureAll.
  [[nodiscard]] const PostSquares& measure() const { return measure_; }
  [[nodiscard]] PostSquares& measure() { return measure_; }

  /// false where the vertex is knotted or has too many neighbours for a ring.
  bool Gather(std::int32_t v, Ring& ring) const;
  /// The same for a vertex with any number of neighbours. Requires: it is on the rim, not knotted.
  [[nodiscard]] std::vector<std::int32_t> GatherRim(std::int32_t v) const;

  /// Moves the ring's centre onto its neighbour b. Requires: all triangles stay sound.
  void Collapse(const Ring& ring, std::int32_t b);
  /// Takes the collapse of v onto b back. gone: a triangle that went with it.
  /// Requires: the triangles that were around v are as that collapse left them, and none has been
  /// compacted or cut off since.
  void TakeBack(std::int32_t v, std::int32_t b, std::int32_t gone);
  /// Turns the edge of h to the other diagonal of its two triangles. Requires: both stay sound.
  void Flip(std::int32_t h);
  /// Takes rim vertex v away and fills what its triangles covered with others between its
  /// neighbours, sound ones where it finds them, else thin ones that turn.
  /// Requires: v is not knotted and between two rim neighbours in a straight line.
  void CutOff(std::int32_t v);
  void SetPlace(std::int32_t v, const Place& place) { at_[v] = place; }
  /// Computes a standing triangle's squares anew.
  void Measure(std::int32_t triangle);
  void MeasureAll();

  /// Closes the gaps that triangles have left; half-edges get new ids.
  void Compact();

 private:
  static constexpr std::uint8_t kKnotted = 255;  // more than kMany, more than a ring holds
  static constexpr std::uint8_t kMany = 254;

  void JoinTwins();
  void MarkKnots();
  void SetTwins(std::int32_t h, std::int32_t other);
  [[nodiscard]] std::int32_t CornerOf(std::int32_t v, std::int32_t triangle) const;
  void SetOut(std::int32_t v, std::int32_t from);
  void ChangeDegree(std::int32_t v, std::int32_t by);

  const Ground* ground_;
  PostSquares measure_;
  Table<Place> at_;  // per vertex
  Table<std::int32_t>
      origin_;  // per half-edge; the complement of the first, where a triangle is gone
  Table<std::int32_t> twin_;    // per half-edge; kNone at the rim
  Table<std::int32_t> out_;     // per vertex: a half-edge from it, the rim's at the rim
  Table<std::uint8_t> degree_;  // per vertex: neighbours; kMany: for good; kKnotted
  Table<float> squares_;        // per triangle
  std::int32_t triangles_ = 0;
};

}  // namespace farhorizon
