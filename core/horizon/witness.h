#pragma once

#include <cstdint>

#include "core/terrain/terrain.h"

namespace farhorizon {

/// A line of sight that touches a segment and nowhere meets higher ground.
/// t: 0 at a, 1 at b; a dyadic number, exact in double. direction: columns and rows, integers below
/// 2^62; nearly always small ones, and above 2^53 only where a search for others has failed.
///
/// exact: false where the sight is certain, but none of those found can be said in a double and two such
/// integers: t and direction are then rounded, and prove nothing. Nearly always because no double at all
/// lies in any gap. Needs cliffs side by side of great height that differ by single quanta: in random
/// terrains of nothing else none was met up to 2^26 quanta, one edge in a thousand at 2^27, one in fifty
/// at 2^31.
struct Witness {
  double t = 0;
  std::int64_t dc = 0;
  std::int64_t dr = 0;
  bool exact = true;
};

/// The greatest height of the terrain over the plan line through `witness` on `edge` is at the
/// witness: a check from the heights alone, independent of how the witness was found. Exact for every
/// double t in [0, 1] and |dc|, |dr| < 2^62; others, and a witness that is not `exact`, do not hold.
/// Cost: O(columns + rows).
bool WitnessHolds(const Terrain& terrain, Edge edge, const Witness& witness);

}  // namespace farhorizon
