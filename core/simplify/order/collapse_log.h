#pragma once

#include <cstdint>
#include <utility>
#include <vector>

#include "core/simplify/mesh/half_edge_mesh.h"

namespace farhorizon {

/// The collapses of a mesh in their order, so that any of them can be taken back, after the later
/// ones that build on it.
/// Memory: 8 bytes a post, and 64 bytes a collapse.
class CollapseLog {
 public:
  static constexpr std::int32_t kNone = -1;

  /// Forgets all, and begins with the mesh as it is. Until End, nothing but collapses, each
  /// recorded, and TakeBack may change which triangles stand and what their corners are.
  void Begin(const HalfEdgeMesh& mesh);
  void End() { *this = {}; }
  [[nodiscard]] bool IsOn() const { return last_.size() > 0; }

  /// Before the collapse of the ring's centre onto the neighbour at place j.
  void Record(const Ring& ring, std::int32_t j);
  /// The last collapse that changed a triangle; kNone where none did.
  [[nodiscard]] std::int32_t LastAt(std::int32_t triangle) const { return last_[triangle]; }
  /// Takes a collapse back that LastAt named, after those that changed its triangles later. Appends
  /// the vertices that stand again, each with the neighbour onto which it had gone.
  void TakeBack(HalfEdgeMesh& mesh, std::int32_t collapse,
                std::vector<std::pair<std::int32_t, std::int32_t>>& back);

 private:
  struct Collapse {
    std::int32_t vertex;  // kNone: taken back
    std::int32_t onto;
    std::int32_t gone;  // a triangle that went
    std::int32_t side;  // the first of its sides_, which end where the next one's begin
  };
  struct Side {
    std::int32_t triangle;
    std::int32_t before;  // LastAt before this collapse
  };
  [[nodiscard]] std::int32_t LaterThan(std::int32_t collapse) const;
  [[nodiscard]] std::size_t EndOfSides(std::int32_t collapse) const;

  std::vector<Collapse> collapses_;
  std::vector<Side> sides_;
  Table<std::int32_t> last_;  // per triangle
};

}  // namespace farhorizon
