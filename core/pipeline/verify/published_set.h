#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <vector>

#include "core/geometry/segment.h"
#include "core/horizon/horizon.h"
#include "core/horizon/lines/highest_over_line.h"
#include "core/terrain/terrain.h"

namespace farhorizon {

/// The segments of a set of horizon edges, asked along lines of sight without any of the structures
/// that the set was found with. Each question is a loop over all segments.
class PublishedSet {
 public:
  PublishedSet(const Terrain& terrain, const Horizon& horizon);

  /// A point of an edge: the edge's place in the horizon, and t from 0 at its end a to 1 at b.
  struct EdgePoint {
    std::size_t edge;
    double t;
  };
  /// The point that is highest over `line`; nullopt where there is none, or several.
  [[nodiscard]] std::optional<EdgePoint> HighestOver(const PlanLine& line) const;

  /// The share of edge i that is visible over all others along [columns, rows] = `direction`.
  /// In floating point: zero comes out as up to 1e-12.
  [[nodiscard]] double VisibleShare(std::size_t i, std::array<double, 2> direction) const;

 private:
  std::vector<Segment> segments_;
};

}  // namespace farhorizon
