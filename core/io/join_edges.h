#pragma once

#include <array>
#include <cstddef>
#include <vector>

namespace farhorizon {

/// An edge as seen from above. Edges meet where they have the same point, bit for bit.
/// kind: edges of unlike kinds are not joined. Requires: a != b.
struct PlanEdge {
  std::array<double, 2> a;
  std::array<double, 2> b;
  int kind = 0;
};

/// An edge in a chain. reversed: the chain runs along it from b to a.
struct ChainedEdge {
  std::size_t edge = 0;
  bool reversed = false;

  friend bool operator==(const ChainedEdge&, const ChainedEdge&) = default;
};

/// Takes every edge once into as few chains as there can be, but closed ones: at each point edges
/// are joined by twos, the two that run straightest first, so that no more than one chain of a kind
/// ends there. Chains that end come first, in the order of their first edges.
/// Cost: O(n log n).
std::vector<std::vector<ChainedEdge>> JoinEdges(const std::vector<PlanEdge>& edges);

}  // namespace farhorizon
