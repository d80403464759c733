#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "core/base/run_control.h"
#include "core/terrain/terrain.h"

namespace farhorizon {

/// The vertices in the order in which a falling plane passes them: by falling height, then by
/// rising number.
struct SweepOrder {
  /// Which neighbours of a post come before it. A post that is no vertex has no neighbours.
  struct NeighbourOrder {
    std::uint16_t before = 0;  ///< bit i: the neighbour at offsets[i] comes before the post
    bool some_after = false;   ///< some neighbour comes after the post
  };

  std::vector<VertexId> vertices;
  std::vector<NeighbourOrder> neighbour_orders;  ///< per post
  /// From a post's number to those of the 3 x 3 posts around it, row by row.
  std::array<VertexId, 9> offsets{};
};

/// nullopt where a stop was requested. The same for any number of threads.
/// Cost: O(n); O(n log n) where the heights take more than 4 n values.
std::optional<SweepOrder> OrderOfSweep(const Terrain& terrain, int threads,
                                       const RunControl& control);

}  // namespace farhorizon
