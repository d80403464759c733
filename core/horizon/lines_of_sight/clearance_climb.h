#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "core/horizon/lines/grid_line_query.h"
#include "core/terrain/terrain.h"

namespace farhorizon {

/// Climbs, in doubles, to a line of sight over which an edge rises above all other edges of the
/// terrain by as much as it can nearby.
class ClearanceClimb {
 public:
  /// Requires: `terrain` and `lines`, of it, outlive this.
  ClearanceClimb(const Terrain& terrain, const GridLineQuery& lines, Edge edge);

  /// A plan line through the edge's point at t, from 0 at edge.a to 1 at edge.b. angle: of its
  /// direction from the columns to the rows, radians.
  struct Line {
    double t = 0;
    double angle = 0;
  };
  static Line LineThrough(double t, double dc, double dr);

  /// The greatest clearance that was found while climbing from `from`: a local maximum within the
  /// tolerance, as a rule. The clearance of a line is the height of the edge over that of the
  /// highest other edge of the terrain, in quanta; 0 where there is no other.
  ///
  /// It is never above the exact clearance of a line, but for a line without any clearance.
  /// tolerance: in quanta. relative: the share of the clearance that is tolerated, too.
  /// Cost: some ten line queries.
  double ClimbFrom(const Line& from, double tolerance, double relative);

  /// The work of all climbs so far, in decisions (core/horizon/work_budget.h).
  [[nodiscard]] std::int64_t work() const { return work_; }

  /// All edges that were the highest over a line that was asked about, in the order in which they
  /// were found first.
  [[nodiscard]] const std::vector<Edge>& obstacles() const { return edges_; }

 private:
  /// Relative to the edge's end a, in doubles.
  struct Obstacle {
    double x;
    double y;
    double z;
    double run_x;
    double run_y;
    double rise;
  };
  /// The tangent plane of a clearance: its value at a line, and how that changes with the line.
  struct Plane {
    double value = 0;
    double by_t = 0;
    double by_angle = 0;
  };
  /// A step of the line, and the clearance that the planes of the obstacles then leave.
  struct Step {
    double t = 0;
    double angle = 0;
    double clearance = 0;
  };
  void Add(Edge edge);
  /// The clearance over the highest other edge, which becomes an obstacle.
  double ClearanceOver(const Line& line);
  /// The clearance over the obstacles alone.
  [[nodiscard]] double ClearanceOverObstacles(const Line& line) const;
  /// The plane of an obstacle, as if it went on beyond its ends; nullopt where it is parallel to
  /// the line, or crossed only by lines beyond `reach` of it.
  [[nodiscard]] std::optional<Plane> PlaneOf(const Obstacle& obstacle, const Line& line,
                                             double reach) const;
  [[nodiscard]] Step BestStep(const Line& line, double reach) const;

  const Terrain& terrain_;
  const GridLineQuery& lines_;
  Edge edge_;
  Point3i start_;
  double run_x_;
  double run_y_;
  double climb_;
  double slack_;
  std::int64_t work_ = 0;
  std::vector<Edge> edges_;
  std::vector<Obstacle> obstacles_;  ///< edges_, in step
};

}  // namespace farhorizon
