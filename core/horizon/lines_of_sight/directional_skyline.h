#pragma once

#include <cstddef>
#include <vector>

#include "core/geometry/interval_tree.h"
#include "core/horizon/horizon.h"
#include "core/horizon/lines_of_sight/lines_of_sight.h"
#include "core/horizon/lines_of_sight/upper_envelope.h"

namespace farhorizon {

/// A part of a horizon edge that is the skyline for a viewer far away.
struct SkylinePart {
  std::size_t edge = 0;  ///< in Horizon::edges
  /// Where on it, 0 at a and 1 at b: the ends of the part by rising Across. To the nearest double; the line
  /// of sight through each t between is a witness.
  double t_from = 0;
  double t_to = 0;
};

/// The skylines of a terrain, one for each direction of view, from its horizon edges alone.
///
/// Which edges a direction may show is looked up in an interval tree of their directions of sight; which
/// part of each it does show is the upper envelope of those.
class DirectionalSkylines {
 public:
  /// Requires: the horizon is FindHorizon's of the terrain, the sights FindLinesOfSight' of both; undecided edges
  /// stand for all directions. Cost: O(n log n) in the number n of horizon edges, about 200 bytes each.
  DirectionalSkylines(const Terrain& terrain, const Horizon& horizon,
                      const std::vector<LinesOfSight>& sights);

  /// The skyline seen along `view`, by rising Across (to the viewer's right where columns, then rows turn
  /// clockwise seen from above, as they do in a DEM whose rows run south). Where edges are seen at one
  /// height, the nearest. Edges along the view, which show as a point, are left out.
  ///
  /// It is the upper envelope of all edges of the terrain, exactly. Cost: O(log n + s log s) for s edges seen
  /// in the direction.
  [[nodiscard]] std::vector<SkylinePart> Along(const ViewDirection& view) const;

 private:
  std::vector<Segment> edges_;
  IntervalTree directions_;
};

}  // namespace farhorizon
