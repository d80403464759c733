#pragma once

#include <cstdint>
#include <vector>

#include "core/horizon/horizon.h"
#include "core/measure/mesh_sides.h"
#include "core/terrain/terrain.h"

namespace farhorizon {

/// Which edges of a terrain are horizon edges, to be asked for very often.
class HorizonIndex {
 public:
  /// Requires: horizon outlives it.
  HorizonIndex(const Terrain& terrain, const Horizon& horizon);

  /// The place in horizon.edges of the edge between two neighbouring posts, a < b; kNoneThere where
  /// it is no horizon edge.
  [[nodiscard]] std::int32_t Find(VertexId a, VertexId b) const;

  /// Of each horizon edge, whether neither end is on the terrain's outline.
  [[nodiscard]] const std::vector<std::uint8_t>& inner() const { return inner_; }
  /// Of each post, whether it is there.
  [[nodiscard]] const std::vector<bool>& outline_posts() const { return outline_posts_; }

 private:
  const Horizon* horizon_;
  std::int32_t columns_;
  std::vector<std::uint8_t> bits_;  // per post a, of the edges to the posts after it
  std::vector<std::uint8_t> inner_;
  std::vector<bool> outline_posts_;
};

}  // namespace farhorizon
