// The silhouette error of any mesh over a grid: how far its skylines are from the DEM's.
#pragma once

#include <cstdint>
#include <vector>

#include "grid.h"

namespace farhorizon::peers {

/// Error of a mesh in H, the greatest height of a surface over a plan line, metres.
struct SilhouetteErrors {
  double rms = 0;
  double max = 0;  ///< where neither skyline is on an outline
  double rim_max =
      0;  ///< where one is: there a line that grazes the outline sees a rounded vertex far off
  std::int64_t lines = 0;
  std::int64_t missed = 0;  ///< lines that meet only one of the two surfaces: in no error above
};

/// The DEM's skylines over parallel plan lines in each of a number of directions.
///
/// Direction k is pi times the fractional part of (0.1234567 + k golden ratio), which no tool
/// samples by rule; lines are 1 / lines_per_cell cells apart, from the corner of the grid on.
class Skylines {
 public:
  Skylines(const Grid& grid, int directions, int lines_per_cell);

  [[nodiscard]] SilhouetteErrors ErrorsOf(const Mesh& mesh) const;

 private:
  struct Segment {
    Point a, b;
    bool rim;  // an edge of one triangle alone
  };
  struct Skyline {
    double height;
    bool rim;
  };
  struct Pencil {
    double along_x, along_y;  // the place of a point across the pencil, in lines from the first
    double first;
    std::vector<Skyline> dem;
  };

  static std::vector<Segment> EdgesOf(const Mesh& mesh);
  static std::vector<Skyline> Over(const Pencil& pencil, const std::vector<Segment>& edges,
                                   std::size_t lines);

  std::vector<Pencil> pencils_;
};

}  // namespace farhorizon::peers
