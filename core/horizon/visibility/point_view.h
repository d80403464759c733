#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "core/exact/quadratic.h"
#include "core/geometry/direction.h"
#include "core/horizon/visibility/direction_set.h"
#include "core/horizon/visibility/moving_vector.h"
#include "core/horizon/visibility/segment_index.h"
#include "core/horizon/visibility/target_segment.h"
#include "core/horizon/visibility/visibility_query.h"

namespace farhorizon {

/// What stands in an arc for the id of a member: a virtual occluder of the hints; the two faces
/// beside the target itself.
inline constexpr OccluderId kVirtualOccluder = -1;
inline constexpr OccluderId kAdjacentFaces = -2;

/// A MovingVector is a + b t with |a|, |b| < 2^50, so at t = n / 2^k with k <= 11 its components
/// times 2^k are below 2 * 2^50 * 2^11 = 2^62, as ShortVector requires.
inline constexpr int kMaxShortBits = 11;

/// The directions that one occluder occludes from one point: from `from` counter-clockwise to `to`.
template <typename Int>
struct BasicOccluderArc {
  MovingVector from;
  MovingVector to;
  BasicDirection<Int> from_direction;
  BasicDirection<Int> to_direction;
  bool crosses_start = false;  ///< passes the end of the half turn and goes on at its start
  bool sliced = false;         ///< one end is the occluder's slice point, not its lower end
  OccluderId occluder = 0;     ///< or kVirtualOccluder, kAdjacentFaces
  std::int32_t low_z = 0;      ///< the occluder's heights
  std::int32_t high_z = 0;
};

enum class PointOutcome {
  kVisible,        ///< in the direction `direction` nothing is higher than the point
  kOccluded,       ///< `arcs` together cover all directions
  kOccludedByOne,  ///< `arcs` has one arc, whose occluder passes over the point in plan
  kAmbiguous,      ///< the point is, in plan, at an end of an occluder or on one: ask another t
  kGaveUp,         ///< the query's decision limit ended the search
};

/// The directions that occluders leave free at one point of a target (core/horizon/README.md,
/// section 4).
/// Int: std::int64_t for points at a ShortDyadic of kMaxShortBits at most, Int128 for those at a
/// Dyadic, Int1280 for those at a WideDyadic.
template <typename Int>
class BasicPointView {
 public:
  using Arc = BasicOccluderArc<Int>;
  using FreeArc = typename BasicDirectionSet<Int>::FreeArc;

  /// Of the query, only `except`, `decision_limit`, for all that `counts` has, and the hints other
  /// than `likely` are used. Requires: all four outlive the view.
  BasicPointView(const SegmentIndex& index, const TargetSegment& target,
                 const VisibilityQuery& query, PredicateCounts* counts);

  /// Decides the point of the target at t; all accessors then are about this point.
  /// likely: members that are tried before all others.
  PointOutcome Evaluate(const BasicDyadic<Int>& t, std::span<const OccluderId> likely);

  [[nodiscard]] const TargetSegment& target() const { return target_; }
  [[nodiscard]] PredicateCounts* counts() const { return counts_; }
  [[nodiscard]] const BasicDyadic<Int>& t() const { return t_; }
  [[nodiscard]] PointOutcome outcome() const { return outcome_; }
  [[nodiscard]] const std::vector<Arc>& arcs() const { return arcs_; }
  /// kVisible: the simplest direction of the widest free arc, not parallel to the target.
  [[nodiscard]] const BasicVector<Int>& direction() const { return direction_; }
  /// kVisible: the widest free arc.
  [[nodiscard]] const FreeArc& free_arc() const { return free_arc_; }

 private:
  using Vector = BasicVector<Int>;

  void MoveTo(const BasicDyadic<Int>& t);
  void AddAdjacentFaces();
  // False where the outcome is settled.
  bool AddVirtualOccluders();
  bool AddMembers(std::span<const OccluderId> likely);
  bool AddUnlessOccluded(OccluderId id, const SegmentIndex::Item& item);
  bool AddOccluder(OccluderId id, const SegmentIndex::Item& item);
  bool AddCollinear(const Arc& arc, const Vector& from, const Vector& to);
  void AddArc(Arc arc, const Vector& from, const Vector& to);
  [[nodiscard]] bool SurelyOccluded(const SegmentIndex::Node& node) const;
  [[nodiscard]] bool SurelyOccluded(const SegmentIndex::Item& item) const;

  const SegmentIndex& index_;
  const TargetSegment& target_;
  const VisibilityQuery& query_;
  PredicateCounts* counts_;

  BasicDyadic<Int> t_;
  double x_ = 0;  ///< of the point, in plan
  double y_ = 0;
  std::int64_t whole_z_ = 0;    ///< the point's height, rounded down
  double fractional_z_ = 0;     ///< the rest: a double of a great height would lose most of it
  Int scaled_z_{};              ///< the point's height times 2^k
  std::int64_t least_top_ = 0;  ///< occluders whose top is lower occlude nothing
  BasicDirectionSet<Int> occluded_;
  std::vector<Arc> arcs_;
  Vector direction_;
  FreeArc free_arc_;
  PointOutcome outcome_ = PointOutcome::kVisible;
};
using ShortPointView = BasicPointView<std::int64_t>;
using PointView = BasicPointView<Int128>;
using WidePointView = BasicPointView<Int1280>;

}  // namespace farhorizon
