#pragma once

#include <cstdint>

namespace farhorizon {

/// How the convex hulls of moving points are certified.
enum class HullCertificates : std::uint8_t {
  kTurns,  ///< the turn at each corner, and a triangle of corners around each other point
  kTree,   ///< the tree of [BaschGuibasHershberger97] over all points ([Archambault03, 3.2.4])
};

}  // namespace farhorizon
