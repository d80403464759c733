#pragma once

#include <cstdint>

#include "core/terrain/terrain.h"

namespace farhorizon {

/// A line of sight that touches a segment and nowhere meets higher ground.
///
/// t: 0 at the segment's first end, 1 at its second; a dyadic number, exact in a double.
/// dc, dr: its direction in columns and rows, integers below 2^62; nearly always small ones, and
/// above 2^53 only where the search for smaller ones failed.
/// exact: false where a line of sight certainly exists, but none was found that a double and two
/// such integers represent, mostly because no double lies in the gap of t. Then t and the direction
/// are rounded and prove nothing. This takes high cliffs side by side whose heights differ by
/// single quanta. In random terrains of such cliffs only, it happened to no edge up to 2^26 quanta,
/// to one in a thousand at 2^27 and to one in fifty at 2^31.
struct Witness {
  double t = 0;
  std::int64_t dc = 0;
  std::int64_t dr = 0;
  bool exact = true;
};

/// Whether the greatest height of the terrain over the plan line through `witness` is the height of
/// `edge` there. Decided from the heights alone, by no code that found the witness. Exact for all t
/// in [0, 1] and |dc|, |dr| < 2^62. False for other witnesses, and for those that are not `exact`.
/// Cost: O(columns + rows).
bool WitnessHolds(const Terrain& terrain, Edge edge, const Witness& witness);

}  // namespace farhorizon
