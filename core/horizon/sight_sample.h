#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "core/exact/quadratic.h"
#include "core/horizon/direction.h"
#include "core/horizon/direction_cover.h"
#include "core/horizon/segment_index.h"

namespace farhorizon {

/// The segment that is asked about, from its lower end (t = 0) to its higher one (t = 1).
struct Sighted {
  Point3i low;
  Point3i high;
  Ties ties = Ties::kPass;

  [[nodiscard]] bool IsLevel() const { return low.z == high.z; }
};

/// A direction that moves linearly with t: from the point of the segment at t to a fixed point, or
/// to where an obstacle rises through that point's height (times the obstacle's rise, a positive
/// number).
struct MovingVector {
  std::int64_t ax = 0;
  std::int64_t ay = 0;
  std::int64_t bx = 0;
  std::int64_t by = 0;

  /// The vector at t, times 2^k.
  [[nodiscard]] Vector At(Dyadic t) const {
    return {(Int128{ax} << t.k) + bx * t.n, (Int128{ay} << t.k) + by * t.n};
  }
  [[nodiscard]] bool IsZero() const { return ax == 0 && ay == 0 && bx == 0 && by == 0; }
};

/// Cross and dot product of two moving vectors.
Quadratic Cross(const MovingVector& a, const MovingVector& b);
Quadratic Dot(const MovingVector& a, const MovingVector& b);

inline constexpr std::int32_t kScreen = -1;

/// What one obstacle hides at one t: directions from `from` counter-clockwise to `to`.
struct Arc {
  MovingVector from;
  MovingVector to;
  Direction from_direction;
  Direction to_direction;
  bool crosses_start = false;
  bool sliced = false;        ///< one of the two is where the obstacle rises through the height
  std::int32_t obstacle = 0;  ///< its id; kScreen for a screen
  std::int32_t low_z = 0;     ///< the obstacle's heights
  std::int32_t high_z = 0;
};

/// What an observer at one point of the segment sees of the obstacles: the directions that they
/// hide.
class SightSample {
 public:
  enum class Outcome {
    kSight,      ///< `sight` is a direction in which nothing rises above the point
    kHidden,     ///< `arcs` together hide every direction
    kEnclosed,   ///< `arcs` has one, whose obstacle passes over the point and hides everything
    kAmbiguous,  ///< the point stands under a corner or a crossing: ask at another t
  };

  SightSample(const SegmentIndex& index, const Sighted& sighted, std::optional<std::int32_t> except,
              std::span<const Segment> screens, PredicateCounts* counts);

  Outcome Look(Dyadic t);

  [[nodiscard]] const std::vector<Arc>& arcs() const { return arcs_; }
  [[nodiscard]] const Vector& sight() const { return sight_; }

 private:
  bool Visit(const SegmentIndex::Node& node);
  /// False where the outcome is settled.
  bool Meet(std::int32_t id, const SegmentIndex::Item& item);
  bool MeetScreens();
  bool MeetCollinear(const Arc& arc, const Vector& from, const Vector& to);
  [[nodiscard]] bool SurelyHidden(const SegmentIndex::Node& node) const;
  [[nodiscard]] bool SurelyHidden(const SegmentIndex::Item& item) const;

  const SegmentIndex& index_;
  const Sighted& sighted_;
  std::optional<std::int32_t> except_;
  std::span<const Segment> screens_;
  PredicateCounts* counts_;

  Dyadic t_;
  double x_ = 0;
  double y_ = 0;
  double z_ = 0;
  Int128 scaled_z_ = 0;         ///< height of the point times 2^k
  std::int64_t least_top_ = 0;  ///< obstacles whose top is lower do not matter
  DirectionCover cover_;
  std::vector<Arc> arcs_;
  Vector sight_;
  Outcome outcome_ = Outcome::kSight;
};

}  // namespace farhorizon
