#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "core/base/progress.h"
#include "core/terrain/terrain.h"

namespace farhorizon {

/// In which order a plane that descends through the terrain meets its vertices: by falling height and rising
/// number.
struct SweepOrder {
  /// Which of a vertex's neighbours come before it.
  struct Around {
    std::uint16_t before = 0;  ///< bit i: the neighbour at offsets[i]
    bool some_after = false;   ///< neither: a post that is no vertex
  };

  std::vector<VertexId> vertices;
  std::vector<Around> around;  ///< a post each
  std::array<VertexId, 9>
      offsets{};  ///< of the posts around, row by row, to their number in the DEM
};

/// Empty where the watch said stop. The same for any `threads`.
/// Cost: O(n); O(n log n) where the heights take more than 4 n values.
std::optional<SweepOrder> OrderOfSweep(const Terrain& terrain, int threads, const Watch& watch);

}  // namespace farhorizon
