#pragma once

#include <cstdint>
#include <vector>

#include "core/terrain/terrain.h"

namespace farhorizon {

/// Which posts of the tile's four sides a level keeps, and at which heights: from each side's own
/// heights and the share alone, so that two tiles that are made apart agree on the side that they
/// share.
///
/// A side is taken piece by piece: a run of posts with data from one gap, or corner, to the next.
/// The ends of runs always stay, at their own heights. Posts at which a level may be cut into parts
/// stay, too (SidePartDepth).
class SidePosts {
 public:
  /// Requires: `terrain` outlives it. Cost: O(m^2) for a side of m posts at worst, O(m log m) on
  /// ground.
  explicit SidePosts(const Terrain& terrain);

  /// The share of a side's posts that stay where a level has this share of all triangles.
  static double ShareOf(double triangles);

  /// A post of a side and its height, metres.
  struct Height {
    VertexId post;
    double height_m;
  };
  /// The posts that stay where this share of a side's posts does, with the heights between which
  /// straight lines come nearest to the side's own in the sum of squares. Corners come twice.
  [[nodiscard]] std::vector<Height> At(double share) const;

 private:
  struct Run {
    VertexId first = 0;
    std::int32_t step = 1;      // from a post to the next
    std::int32_t offset = 0;    // of its first post, from the side's
    std::int32_t side = 0;      // posts of the whole side
    std::vector<double> m;      // heights, metres
    std::vector<double> leave;  // for each post the share of the run that has gone when it goes
  };
  void FindRuns(VertexId first, std::int32_t step, std::int32_t count);
  void AddRun(Run run, std::int32_t count);
  [[nodiscard]] std::vector<std::size_t> Staying(const Run& run, double share) const;

  const Terrain* terrain_;
  std::vector<Run> runs_;
};

}  // namespace farhorizon
