#pragma once

#include <cstddef>
#include <vector>

#include "core/geometry/interval_tree.h"
#include "core/horizon/horizon.h"
#include "core/horizon/lines_of_sight/lines_of_sight.h"
#include "core/horizon/lines_of_sight/upper_envelope.h"

namespace farhorizon {

/// A piece of a horizon edge that is on the skyline of one direction.
struct SkylinePiece {
  std::size_t edge = 0;  ///< in Horizon::edges
  /// The ends of the piece on the edge, by rising Offset: 0 at a and 1 at b, to the nearest double.
  /// The line of sight through each t between is a witness.
  double t_from = 0;
  double t_to = 0;
};

/// The skylines of a terrain for viewers far away, one for each direction of view, from the lines
/// of sight of its horizon edges alone (core/horizon/README.md, theorem 11).
///
/// An interval tree of the edges' directions of sight tells which edges can be on the skyline of a
/// direction; the upper envelope of these is the skyline.
class DirectionalSkylines {
 public:
  /// Edges without lines of sight, undecided ones among them, count as visible in all directions.
  /// Requires: the horizon is FindHorizon's of the terrain, and `lines` are FindLinesOfSight's of
  /// both.
  /// Cost: O(n log n) for n horizon edges, about 200 bytes each.
  DirectionalSkylines(const Terrain& terrain, const Horizon& horizon,
                      const std::vector<LinesOfSight>& lines);

  /// The skyline along `view`, by rising Offset: to the viewer's right in a DEM whose rows run
  /// south, where columns, then rows turn clockwise as seen from above. Of edges at one height the
  /// nearest is taken. Edges parallel to the view, which are points of it, are left out.
  ///
  /// Exactly the upper envelope of all edges of the terrain. Cost: O(log n + s log s) for s edges
  /// with the direction among their directions of sight.
  [[nodiscard]] std::vector<SkylinePiece> Along(const ViewDirection& view) const;

 private:
  std::vector<Segment> edges_;
  IntervalTree directions_;
};

}  // namespace farhorizon
