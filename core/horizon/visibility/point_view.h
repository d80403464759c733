#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "core/exact/quadratic.h"
#include "core/geometry/direction.h"
#include "core/horizon/visibility/direction_set.h"
#include "core/horizon/visibility/segment_index.h"

namespace farhorizon {

/// The segment that is asked about, from its lower end (t = 0) to its higher one (t = 1).
struct TargetSegment {
  Point3i low;
  Point3i high;
  Ties ties = Ties::kPass;

  [[nodiscard]] bool IsHorizontal() const { return low.z == high.z; }
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
  template <typename Int>
  [[nodiscard]] BasicVector<Int> At(const BasicDyadic<Int>& t) const {
    return {(Int{ax} << t.k) + Int{bx} * t.n, (Int{ay} << t.k) + Int{by} * t.n};
  }
  [[nodiscard]] bool IsZero() const { return ax == 0 && ay == 0 && bx == 0 && by == 0; }
  friend bool operator==(const MovingVector&, const MovingVector&) = default;
};

/// From the point of the segment at t to `v`.
MovingVector ToPoint(const TargetSegment& e, const Point3i& v);
/// From there to the point of low -> high at the height of the segment's point, times the rise of
/// low -> high. Requires: low.z < high.z.
MovingVector ToSlice(const TargetSegment& e, const Point3i& low, const Point3i& high);

/// Cross and dot product of two moving vectors.
Quadratic Cross(const MovingVector& a, const MovingVector& b);
Quadratic Dot(const MovingVector& a, const MovingVector& b);

/// What hides instead of a member: a virtual occluder, the faces beside the segment itself.
inline constexpr std::int32_t kVirtualOccluder = -1;
inline constexpr std::int32_t kFaces = -2;

/// A MovingVector's numbers are below 2^50 (17 bits of plan, 31 of height, a sum of two), so at a
/// point of so many bits it stays below 2^62.
inline constexpr int kMaxShortBits = 11;

/// What one obstacle hides at one t: directions from `from` counter-clockwise to `to`.
template <typename Int>
struct BasicArc {
  MovingVector from;
  MovingVector to;
  BasicDirection<Int> from_direction;
  BasicDirection<Int> to_direction;
  bool crosses_start = false;
  bool sliced = false;        ///< one of the two is where the obstacle rises through the height
  std::int32_t obstacle = 0;  ///< its id; kVirtualOccluder; kFaces
  std::int32_t low_z = 0;     ///< the obstacle's heights
  std::int32_t high_z = 0;
};

enum class PointOutcome {
  kVisible,    ///< `sight` is a direction in which nothing rises above the point
  kOccluded,   ///< `arcs` together hide every direction
  kEnclosed,   ///< `arcs` has one, whose obstacle passes over the point and hides everything
  kAmbiguous,  ///< the point stands under a corner or a crossing: ask at another t
};

/// What an observer at one point of the segment sees of the obstacles: the directions that they
/// hide. Int: std::int64_t for points at a ShortDyadic of at most kMaxShortBits, Int128 for those at a
/// Dyadic, Int1280 for those at a WideDyadic.
template <typename Int>
class BasicPointView {
 public:
  using Arc = BasicArc<Int>;
  using Vector = BasicVector<Int>;

  /// hints: must outlive the sample; its `likely` are not looked at.
  BasicPointView(const SegmentIndex& index, const TargetSegment& target,
                 std::optional<std::int32_t> except, const OcclusionHints& hints,
                 PredicateCounts* counts);

  /// likely: obstacles that are tried before all others.
  PointOutcome Look(const BasicDyadic<Int>& t, std::span<const std::int32_t> likely);

  [[nodiscard]] const std::vector<Arc>& arcs() const { return arcs_; }
  [[nodiscard]] const Vector& sight() const { return sight_; }
  /// The widest range of directions that is free, where there is a sight.
  [[nodiscard]] const typename BasicDirectionSet<Int>::Gap& gap() const { return gap_; }

 private:
  // False where the outcome is settled.
  bool Visit(const SegmentIndex::Node& node);
  bool AddIfVisible(std::int32_t id, const SegmentIndex::Item& item);
  bool AddObstacle(std::int32_t id, const SegmentIndex::Item& item);
  void AddFaces();
  bool AddVirtualOccluders();
  void AddArc(Arc arc, const Vector& from, const Vector& to);
  bool AddCollinear(const Arc& arc, const Vector& from, const Vector& to);
  [[nodiscard]] bool SurelyOccluded(const SegmentIndex::Node& node) const;
  [[nodiscard]] bool SurelyOccluded(const SegmentIndex::Item& item) const;

  const SegmentIndex& index_;
  const TargetSegment& target_;
  std::optional<std::int32_t> except_;
  const OcclusionHints& hints_;
  PredicateCounts* counts_;

  BasicDyadic<Int> t_;
  double x_ = 0;
  double y_ = 0;
  std::int64_t whole_z_ = 0;    ///< height of the point, rounded down
  double part_z_ = 0;           ///< the rest: doubles of great heights would be off by a lot of it
  Int scaled_z_{};              ///< height of the point times 2^k
  std::int64_t least_top_ = 0;  ///< obstacles whose top is lower do not matter
  BasicDirectionSet<Int> cover_;
  std::vector<Arc> arcs_;
  Vector sight_;
  typename BasicDirectionSet<Int>::Gap gap_;
  PointOutcome outcome_ = PointOutcome::kVisible;
};
using ShortPointView = BasicPointView<std::int64_t>;
using PointView = BasicPointView<Int128>;
using WidePointView = BasicPointView<Int1280>;

}  // namespace farhorizon
