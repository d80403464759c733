// What can be seen from one point p = e(t) of a segment e, among obstacles.
// An obstacle f hides the lines through p that meet the part of f above p: an arc of directions,
// from the direction of f's lower end, or of the point where f rises through p's height, to that of
// its upper end. The union of the arcs is gathered near to far; boxes that lie in directions
// already hidden are skipped.
#include "core/horizon/visibility/point_view.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "core/base/result.h"

namespace farhorizon {
MovingVector ToPoint(const TargetSegment& e, const Point3i& v) {
  return {v.x - e.low.x, v.y - e.low.y, e.low.x - e.high.x, e.low.y - e.high.y};
}

MovingVector ToSlice(const TargetSegment& e, const Point3i& low, const Point3i& high) {
  const std::int64_t rise = std::int64_t{high.z} - low.z;
  const std::int64_t below = std::int64_t{e.low.z} - low.z;
  const std::int64_t climb = std::int64_t{e.high.z} - e.low.z;
  const std::int64_t run_x = high.x - low.x;
  const std::int64_t run_y = high.y - low.y;
  return {(low.x - e.low.x) * rise + run_x * below, (low.y - e.low.y) * rise + run_y * below,
          (e.low.x - e.high.x) * rise + run_x * climb, (e.low.y - e.high.y) * rise + run_y * climb};
}

Quadratic Cross(const MovingVector& a, const MovingVector& b) {
  return {Int128{a.ax} * b.ay - Int128{a.ay} * b.ax,
          Int128{a.ax} * b.by - Int128{a.ay} * b.bx + Int128{a.bx} * b.ay - Int128{a.by} * b.ax,
          Int128{a.bx} * b.by - Int128{a.by} * b.bx};
}

Quadratic Dot(const MovingVector& a, const MovingVector& b) {
  return {Int128{a.ax} * b.ax + Int128{a.ay} * b.ay,
          Int128{a.ax} * b.bx + Int128{a.ay} * b.by + Int128{a.bx} * b.ax + Int128{a.by} * b.ay,
          Int128{a.bx} * b.bx + Int128{a.by} * b.by};
}

template <typename Int>
BasicPointView<Int>::BasicPointView(const SegmentIndex& index, const TargetSegment& target,
                                    std::optional<std::int32_t> except, const OcclusionHints& hints,
                                    PredicateCounts* counts)
    : index_(index), target_(target), except_(except), hints_(hints), counts_(counts) {}

template <typename Int>
PointOutcome BasicPointView<Int>::Look(const BasicDyadic<Int>& t,
                                       std::span<const std::int32_t> likely) {
  t_ = t;
  const double where = t.ToDouble();
  x_ = target_.low.x + (target_.high.x - target_.low.x) * where;
  y_ = target_.low.y + (target_.high.y - target_.low.y) * where;
  const std::int64_t climb = std::int64_t{target_.high.z} - target_.low.z;
  scaled_z_ = (Int{target_.low.z} << t.k) + Int{climb} * t.n;
  whole_z_ = static_cast<std::int64_t>(scaled_z_ >> t.k);
  part_z_ = BasicDyadic<Int>{scaled_z_ - (Int{whole_z_} << t.k), t.k}.ToDouble();
  const bool level_hides = target_.IsHorizontal() && target_.ties == Ties::kBlock;
  least_top_ = whole_z_ + (level_hides ? 0 : 1);
  cover_ = BasicDirectionSet<Int>();
  arcs_.clear();
  outcome_ = PointOutcome::kOccluded;

  AddFaces();
  if (!AddVirtualOccluders()) return outcome_;
  for (const std::int32_t id : likely) {
    if (!AddIfVisible(id, index_.item(id))) return outcome_;
  }
  struct Pending {
    SegmentIndex::Place place;
    double distance;
  };
  std::array<Pending, 128> stack;
  std::size_t depth = 0;
  stack[depth++] = {index_.Root(), 0};
  while (depth > 0) {
    const SegmentIndex::Place place = stack[--depth].place;
    const SegmentIndex::Node& node = index_.At(place);
    if (node.top < least_top_ || SurelyOccluded(node)) continue;
    if (!Visit(node)) return outcome_;
    if (place.level == 0) continue;
    const std::size_t base = depth;
    for (std::int32_t child = 0; child < 4; ++child) {
      const SegmentIndex::Place below{place.level - 1, 2 * place.x + (child & 1),
                                      2 * place.y + (child >> 1)};
      if (!index_.Exists(below)) continue;
      const SegmentIndex::Node& node_below = index_.At(below);
      if (node_below.top < least_top_) continue;
      stack[depth++] = {below, node_below.SquaredDistance(x_, y_)};
    }
    // The nearest child last, so that it is the next.
    std::sort(stack.begin() + static_cast<std::ptrdiff_t>(base),
              stack.begin() + static_cast<std::ptrdiff_t>(depth),
              [](const Pending& a, const Pending& b) { return a.distance > b.distance; });
  }
  const auto gap = cover_.WidestGap();
  Check(gap.has_value(), "a complete cover ends the search");
  const Vector along{Int{target_.high.x - target_.low.x}, Int{target_.high.y - target_.low.y}};
  gap_ = *gap;
  sight_ = SimplestBetween(gap->from, gap->to, along);
  return PointOutcome::kVisible;
}

template <typename Int>
bool BasicPointView<Int>::Visit(const SegmentIndex::Node& node) {
  for (std::int32_t id = node.first; id >= 0;) {
    const SegmentIndex::Item& item = index_.item(id);
    if (!AddIfVisible(id, item)) return false;
    id = item.next;
  }
  return true;
}

template <typename Int>
bool BasicPointView<Int>::AddIfVisible(std::int32_t id, const SegmentIndex::Item& item) {
  if (!item.alive || item.high.z < least_top_ || id == except_ || SurelyOccluded(item)) return true;
  return AddObstacle(id, item);
}

template <typename Int>
void BasicPointView<Int>::AddFaces() {
  if (!hints_.wedge) return;
  // From where the wedge ends round to where it begins again.
  Arc arc;
  arc.obstacle = kFaces;
  arc.from = {hints_.wedge->last.x, hints_.wedge->last.y, 0, 0};
  arc.to = {-hints_.wedge->first.x, -hints_.wedge->first.y, 0, 0};
  AddArc(arc, arc.from.At(t_), arc.to.At(t_));
}

template <typename Int>
bool BasicPointView<Int>::AddVirtualOccluders() {
  for (const Segment& virtual_occluder : hints_.virtual_occluders) {
    const SegmentIndex::Item item{virtual_occluder.a, virtual_occluder.b};
    if (item.high.z >= least_top_ && !SurelyOccluded(item) && !AddObstacle(kVirtualOccluder, item))
      return false;
  }
  return true;
}

template <typename Int>
bool BasicPointView<Int>::AddObstacle(std::int32_t id, const SegmentIndex::Item& item) {
  if (item.high.z == least_top_ && (Int{item.high.z} << t_.k) == scaled_z_ &&
      item.low.z != item.high.z) {
    return true;  // only its upper end is at the height of level ground
  }
  Arc arc;
  arc.obstacle = id;
  arc.low_z = item.low.z;
  arc.high_z = item.high.z;
  arc.sliced = (Int{item.low.z} << t_.k) < scaled_z_;
  arc.from = arc.sliced ? ToSlice(target_, item.low, item.high) : ToPoint(target_, item.low);
  arc.to = ToPoint(target_, item.high);
  Vector from = arc.from.At(t_);
  Vector to = arc.to.At(t_);
  if (arc.sliced && arc.from.IsZero()) {
    // The obstacle lies along the segment itself, at its height: it hides it where ties do.
    if (target_.ties == Ties::kPass) return true;
    arcs_.assign(1, arc);
    outcome_ = PointOutcome::kEnclosed;
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
  return !cover_.IsComplete();
}

template <typename Int>
void BasicPointView<Int>::AddArc(Arc arc, const Vector& from, const Vector& to) {
  arc.from_direction = MakeDirection(from);
  arc.to_direction = MakeDirection(to);
  arc.crosses_start = arc.from_direction.turned != arc.to_direction.turned;
  arcs_.push_back(arc);
  cover_.Add(arc.from_direction, arc.to_direction, arc.crosses_start, counts_);
}

template <typename Int>
bool BasicPointView<Int>::AddCollinear(const Arc& arc, const Vector& from, const Vector& to) {
  if (DotSign(from, to) > 0) {
    // Seen end on: one direction, which no sight may take.
    const BasicDirection<Int> direction = MakeDirection(from);
    cover_.Add(direction, direction, false, counts_);
    return true;
  }
  if (Cross(arc.from, arc.to).IsZero()) {
    arcs_.assign(1, arc);
    outcome_ = PointOutcome::kEnclosed;
  } else {
    outcome_ = PointOutcome::kAmbiguous;
  }
  return false;
}

template <typename Int>
bool BasicPointView<Int>::SurelyOccluded(const SegmentIndex::Node& node) const {
  return cover_.SurelyContains(PlanBox{0.5 * (node.min_x + static_cast<double>(node.max_x)) - x_,
                                       0.5 * (node.min_y + static_cast<double>(node.max_y)) - y_,
                                       0.5 * (static_cast<double>(node.max_x) - node.min_x),
                                       0.5 * (static_cast<double>(node.max_y) - node.min_y)});
}

template <typename Int>
bool BasicPointView<Int>::SurelyOccluded(const SegmentIndex::Item& item) const {
  PlanStroke part{item.low.x - x_, item.low.y - y_, item.high.x - x_, item.high.y - y_};
  const double above_low = static_cast<double>(whole_z_ - item.low.z) + part_z_;
  if (above_low > 0) {
    const double share = above_low / (static_cast<double>(item.high.z) - item.low.z);
    part.from_x += share * (part.to_x - part.from_x);
    part.from_y += share * (part.to_y - part.from_y);
  }
  return cover_.SurelyContains(part);
}

template class BasicPointView<std::int64_t>;
template class BasicPointView<Int128>;
template class BasicPointView<Int1280>;

}  // namespace farhorizon
