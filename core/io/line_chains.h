#pragma once

#include <array>
#include <optional>
#include <vector>

#include "core/io/azimuth_mask.h"

namespace farhorizon {

/// An edge of a level that has the level's own skyline on it somewhere.
///
/// ends: in numbers of the level's lattice, as its mesh has them.
/// azimuths: directions of sight in which the edge is on the skyline, rounded outwards to bits.
/// line_measure_m, skyline_drop_m: those of the DEM's horizon edge (EdgeMeasures); unset where the
///   edge is a chord of the level's own, or the measure is not known.
struct HorizonLine {
  std::array<std::array<float, 3>, 2> ends = {};
  AzimuthMask azimuths = 0;
  std::optional<float> line_measure_m;
  std::optional<float> skyline_drop_m;

  friend bool operator==(const HorizonLine&, const HorizonLine&) = default;
};

/// Such edges one behind the other, as they are published.
///
/// points: one more than edges; a point may be there more than once.
/// azimuths: those of all its edges. line_measure_m: the sum, skyline_drop_m: the greatest, of
///   those edges that have one; unset where none has.
struct LineChain {
  std::vector<std::array<float, 3>> points;
  AzimuthMask azimuths = 0;
  std::optional<float> line_measure_m;
  std::optional<float> skyline_drop_m;

  friend bool operator==(const LineChain&, const LineChain&) = default;
};

/// Takes every edge once into chains, as JoinEdges does. Requires: no edge is upright.
/// Cost: O(n log n).
std::vector<LineChain> LineChainsOf(const std::vector<HorizonLine>& lines);

}  // namespace farhorizon
