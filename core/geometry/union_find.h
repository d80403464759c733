#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

namespace farhorizon {

/// The root of `node` in a forest that stands for disjoint sets: `parents` holds the parent of each
/// node, and a root is its own. Halves the path on its way, so that later searches are shorter.
///
/// To join two sets, make one's root the parent of the other's.
/// Cost: O(log n) amortized over all searches, whichever root is chosen.
inline std::int32_t FindRoot(std::span<std::int32_t> parents, std::int32_t node) {
  for (;;) {
    std::int32_t& parent = parents[static_cast<std::size_t>(node)];
    if (parent == node) return node;
    parent = parents[static_cast<std::size_t>(parent)];
    node = parent;
  }
}

}  // namespace farhorizon
