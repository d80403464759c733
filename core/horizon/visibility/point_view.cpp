// The directions in which a line of sight may leave one point p = e(t) of the target e. An occluder
// f occludes the lines through p that cross the part of f above p. That part runs from f's lower
// end, or, where that end is below p, from the slice point, to f's upper end; in the plan:
//
//               low  x - - - - o==========x  high         f; above p from the slice point o on
//                             /         .
//                            /  arc   .
//                     from  /       .  to                 counter-clockwise; if `high` is the first
//                          /      .                       of the two, the ends change roles
//                         /     .
//                        /    .
//     e  --------------- p ----------------               each direction stands for its opposite,
//                                                         too: a line has no sense
//
// Where p, low and high are in line, f is seen end on (an arc of one direction), or passes over p.
// Members are added near to far; boxes and members in directions that are occluded already are
// skipped. The search ends when all directions are occluded (core/horizon/README.md, theorem 8).
// Cost: about the members that are visible from p, times the arcs that the set consists of.
#include "core/horizon/visibility/point_view.h"

#include <algorithm>
#include <utility>

#include "core/base/result.h"

namespace farhorizon {

template <typename Int>
BasicPointView<Int>::BasicPointView(const SegmentIndex& index, const TargetSegment& target,
                                    const VisibilityQuery& query, PredicateCounts* counts)
    : index_(index), target_(target), query_(query), counts_(counts) {}

template <typename Int>
PointOutcome BasicPointView<Int>::Evaluate(const BasicDyadic<Int>& t,
                                           std::span<const OccluderId> likely) {
  MoveTo(t);
  occluded_ = BasicDirectionSet<Int>();
  arcs_.clear();
  outcome_ = PointOutcome::kOccluded;
  AddAdjacentFaces();
  if (!AddVirtualOccluders() || !AddMembers(likely)) return outcome_;

  const std::optional<FreeArc> widest = occluded_.WidestFreeArc();
  Check(widest.has_value(), "the search ends when all directions are occluded");
  const Vector along{Int{target_.high.x - target_.low.x}, Int{target_.high.y - target_.low.y}};
  free_arc_ = *widest;
  direction_ = SimplestBetween(widest->from, widest->to, along);
  outcome_ = PointOutcome::kVisible;
  return outcome_;
}

template <typename Int>
void BasicPointView<Int>::MoveTo(const BasicDyadic<Int>& t) {
  t_ = t;
  const double where = t.ToDouble();
  x_ = target_.low.x + (target_.high.x - target_.low.x) * where;
  y_ = target_.low.y + (target_.high.y - target_.low.y) * where;
  const std::int64_t climb = std::int64_t{target_.high.z} - target_.low.z;
  scaled_z_ = (Int{target_.low.z} << t.k) + Int{climb} * t.n;
  whole_z_ = static_cast<std::int64_t>(scaled_z_ >> t.k);
  fractional_z_ = BasicDyadic<Int>{scaled_z_ - (Int{whole_z_} << t.k), t.k}.ToDouble();
  const bool equal_height_occludes = target_.IsHorizontal() && target_.ties == Ties::kBlock;
  least_top_ = whole_z_ + (equal_height_occludes ? 0 : 1);
}

template <typename Int>
void BasicPointView<Int>::AddAdjacentFaces() {
  const std::optional<FaceWedge>& wedge = query_.hints.wedge;
  if (!wedge) return;
  // The complement of the wedge: from its last direction on to half a turn beyond its first.
  Arc arc;
  arc.occluder = kAdjacentFaces;
  arc.from = {wedge->last.x, wedge->last.y, 0, 0};
  arc.to = {-wedge->first.x, -wedge->first.y, 0, 0};
  AddArc(arc, arc.from.At(t_), arc.to.At(t_));
}

template <typename Int>
bool BasicPointView<Int>::AddVirtualOccluders() {
  for (const Segment& segment : query_.hints.virtual_occluders) {
    const SegmentIndex::Item item{segment.a, segment.b};
    if (item.high.z >= least_top_ && !SurelyOccluded(item) &&
        !AddOccluder(kVirtualOccluder, item)) {
      return false;
    }
  }
  return true;
}

template <typename Int>
bool BasicPointView<Int>::AddMembers(std::span<const OccluderId> likely) {
  for (const OccluderId id : likely) {
    const SegmentIndex::Item& item = index_.item(id);
    if (item.alive && !AddUnlessOccluded(id, item)) return false;
  }
  return index_.VisitNearFirst(
      x_, y_, least_top_, [this](const SegmentIndex::Node& node) { return !SurelyOccluded(node); },
      [this](OccluderId id, const SegmentIndex::Item& item) {
        return AddUnlessOccluded(id, item);
      });
}

template <typename Int>
bool BasicPointView<Int>::AddUnlessOccluded(OccluderId id, const SegmentIndex::Item& item) {
  if (item.high.z < least_top_ || id == query_.except || SurelyOccluded(item)) return true;
  if (query_.decision_limit && counts_->Sum() >= *query_.decision_limit) {
    outcome_ = PointOutcome::kGaveUp;
    return false;
  }
  return AddOccluder(id, item);
}

template <typename Int>
bool BasicPointView<Int>::AddOccluder(OccluderId id, const SegmentIndex::Item& item) {
  if (item.high.z == least_top_ && (Int{item.high.z} << t_.k) == scaled_z_ &&
      item.low.z != item.high.z) {
    return true;  // ties block, and only the upper end is at the target's height: one direction
  }
  Arc arc;
  arc.occluder = id;
  arc.low_z = item.low.z;
  arc.high_z = item.high.z;
  arc.sliced = (Int{item.low.z} << t_.k) < scaled_z_;
  arc.from = arc.sliced ? ToSlice(target_, item.low, item.high) : ToPoint(target_, item.low);
  arc.to = ToPoint(target_, item.high);
  Vector from = arc.from.At(t_);
  Vector to = arc.to.At(t_);
  if (arc.sliced && arc.from.IsZero()) {
    // The occluder is in the target's own line, at its height: a tie at every t.
    if (target_.ties == Ties::kPass) return true;
    arcs_.assign(1, arc);
    outcome_ = PointOutcome::kOccludedByOne;
    return false;
  }
  if (from.IsZero() || to.IsZero()) {
    outcome_ = PointOutcome::kAmbiguous;
    return false;
  }
  const int turn = CrossSign(from, to);
  if (turn == 0) return AddCollinear(arc, from, to);
  if (turn < 0) {
    std::swap(arc.from, arc.to);
    std::swap(from, to);
  }
  AddArc(arc, from, to);
  return !occluded_.IsComplete();
}

template <typename Int>
bool BasicPointView<Int>::AddCollinear(const Arc& arc, const Vector& from, const Vector& to) {
  if (DotSign(from, to) > 0) {
    // The occluder is seen end on. Its one direction is left out, so that no witness runs along it.
    const BasicDirection<Int> direction = MakeDirection(from);
    occluded_.Add(direction, direction, false, counts_);
    return true;
  }
  // The occluder passes over the point: at every t if the two are in one line, else here only.
  if (Cross(arc.from, arc.to).IsZero()) {
    arcs_.assign(1, arc);
    outcome_ = PointOutcome::kOccludedByOne;
  } else {
    outcome_ = PointOutcome::kAmbiguous;
  }
  return false;
}

template <typename Int>
void BasicPointView<Int>::AddArc(Arc arc, const Vector& from, const Vector& to) {
  arc.from_direction = MakeDirection(from);
  arc.to_direction = MakeDirection(to);
  arc.crosses_start = arc.from_direction.turned != arc.to_direction.turned;
  arcs_.push_back(arc);
  occluded_.Add(arc.from_direction, arc.to_direction, arc.crosses_start, counts_);
}

template <typename Int>
bool BasicPointView<Int>::SurelyOccluded(const SegmentIndex::Node& node) const {
  return occluded_.SurelyContains(PlanBox{0.5 * (node.min_x + static_cast<double>(node.max_x)) - x_,
                                          0.5 * (node.min_y + static_cast<double>(node.max_y)) - y_,
                                          0.5 * (static_cast<double>(node.max_x) - node.min_x),
                                          0.5 * (static_cast<double>(node.max_y) - node.min_y)});
}

// Coordinates are below 2^17 and off by less than 2^-32, far less than DirectionSet allows: x_ and
// y_ by a few roundings, the slice point by the ratio of two numbers that are off by a rounding or
// two.
template <typename Int>
bool BasicPointView<Int>::SurelyOccluded(const SegmentIndex::Item& item) const {
  PlanSegment above{item.low.x - x_, item.low.y - y_, item.high.x - x_, item.high.y - y_};
  const double above_low = static_cast<double>(whole_z_ - item.low.z) + fractional_z_;
  if (above_low > 0) {
    const double share = above_low / (static_cast<double>(item.high.z) - item.low.z);
    above.from_x += share * (above.to_x - above.from_x);
    above.from_y += share * (above.to_y - above.from_y);
  }
  return occluded_.SurelyContains(above);
}

template class BasicPointView<std::int64_t>;
template class BasicPointView<Int128>;
template class BasicPointView<Int1280>;

}  // namespace farhorizon
