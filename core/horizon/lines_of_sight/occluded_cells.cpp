// The cells that one occluder takes from an edge's strip. From the edge's point p at t, it occludes
// the directions between two moving vectors (core/horizon/README.md, section 4): that to its lower
// end, or to its slice point where it rises through p's height, and that to its upper end. Both are
// brought into the half turn; the strip is cut at the t where the arc between them changes its
// form.
//
//          high x                              high x
//              /                                   /
//             o slice point                       /
//                                                /
//     - - - p - - - - > the edge        - - - p / - - - - > the edge
//                                              /
//                                         low x
//
// Ends on one side of the edge's line: the directions from one end to the other. Ends on both
// sides, the occluder ahead of p: those from kAlong to the end on the left, and those from the end
// on the right, turned by half a turn, to kAgainst. Behind p, left and right change places.
#include "core/horizon/lines_of_sight/occluded_cells.h"

#include <numeric>
#include <utility>

namespace farhorizon {

namespace {

using Kind = BoundaryCurve::Kind;

void Append(std::vector<IsolatedRoot>& roots, const RootPair& more) {
  roots.insert(roots.end(), more.begin(), more.end());
}

// One end of the arc that an occluder takes: the vector to it and its side of the edge's line, 1 on
// the left, -1 on the right, 0 on the line.
struct ArcEnd {
  MovingVector v;
  int side;
};

// The curve of an arc's end in the half turn.
//
// A vector of one direction for all t, such as that to an end shared with the edge, is replaced by
// a constant one in lowest terms. That one is nowhere zero, and equal to other curves of its
// direction. (The vector itself may be zero at one t and opposite beyond, where only the line of
// the occluder passes through the edge's point.)
BoundaryCurve CurveOf(const MovingVector& along, const ArcEnd& end) {
  MovingVector v = end.v;
  if (Int128{v.ax} * v.by == Int128{v.ay} * v.bx) {
    const bool starts_at_zero = v.ax == 0 && v.ay == 0;
    const std::int64_t x = starts_at_zero ? v.bx : v.ax;
    const std::int64_t y = starts_at_zero ? v.by : v.ay;
    const std::int64_t divisor = std::gcd(x, y);
    v = {x / divisor, y / divisor, 0, 0};
    if (SignOf(Cross(along, v).c0) < 0) v = {-v.ax, -v.ay, 0, 0};
    return {Kind::kMoving, v};
  }
  if (end.side > 0) return {Kind::kMoving, v};
  return {Kind::kMoving, {-v.ax, -v.ay, -v.bx, -v.by}};
}

// The directions of the arc from a to b, or b to a, around the point: each pair from its first
// curve counter-clockwise to its last.
CurvePairs OccludedDirections(const MovingVector& along, const ArcEnd& a, const ArcEnd& b,
                              const SamplePoint& point) {
  if (a.side == 0 && b.side == 0) return {};  // in line with the edge: one direction
  if (a.side == 0 || b.side == 0) {
    const ArcEnd& on_line = a.side == 0 ? a : b;
    const ArcEnd& other = a.side == 0 ? b : a;
    const bool ahead = point.Sign(Dot(along, on_line.v)) * other.side > 0;
    if (ahead) return {BoundaryCurve::Along(), CurveOf(along, other)};
    return {CurveOf(along, other), BoundaryCurve::Against()};
  }
  BoundaryCurve first = CurveOf(along, a);
  BoundaryCurve last = CurveOf(along, b);
  const int turn = Order(first, last, point);
  if (turn == 0) return {};
  if (turn < 0) std::swap(first, last);
  if (a.side == b.side) return {first, last};
  // Across the edge's line, ahead of the point or behind it: all directions except those between.
  CurvePairs outside(BoundaryCurve::Along(), first);
  outside.Add(last, BoundaryCurve::Against());
  return outside;
}

}  // namespace

std::vector<StripCell> CellsOccludedBy(const SegmentIndex::Item& item, const TargetSegment& edge) {
  const MovingVector along{std::int64_t{edge.high.x} - edge.low.x,
                           std::int64_t{edge.high.y} - edge.low.y, 0, 0};
  const Int128 climb = Int128{edge.high.z} - edge.low.z;
  // Positive where the edge's point is below the occluder's upper end, above its lower end.
  const Quadratic below_high{Int128{item.high.z} - edge.low.z, -climb, 0};
  const Quadratic above_low{Int128{edge.low.z} - item.low.z, climb, 0};
  const MovingVector to_low = ToPoint(edge, item.low);
  const MovingVector to_high = ToPoint(edge, item.high);
  const bool sliced_somewhere = above_low.c0 + above_low.c1 > 0;
  const MovingVector to_slice =
      sliced_somewhere && item.low.z < item.high.z ? ToSlice(edge, item.low, item.high) : to_low;
  const Quadratic slice_side = Cross(along, to_slice);

  std::vector<IsolatedRoot> roots;
  roots.reserve(6);  // that is all, as a rule
  Append(roots, SignChanges(below_high));
  Append(roots, SignChanges(above_low));
  if (sliced_somewhere) Append(roots, SignChanges(slice_side));
  Append(roots, SignChanges(Cross(to_low, to_high)));
  const std::vector<IsolatedRoot> cuts =
      Cuts(IsolatedRoot::Zero(), std::move(roots), IsolatedRoot::One());

  std::vector<StripCell> occluded;
  StripBuilder strip(occluded);
  const int low_side = SignOf(Cross(along, to_low).c0);
  const int high_side = SignOf(Cross(along, to_high).c0);
  for (std::size_t i = 0; i + 1 < cuts.size(); ++i) {
    const SamplePoint point = PointBetween(cuts[i], cuts[i + 1]);
    if (point.Sign(below_high) <= 0) {
      strip.AddSlab(cuts[i], cuts[i + 1], {});
      continue;
    }
    const ArcEnd low = point.Sign(above_low) > 0 ? ArcEnd{to_slice, point.Sign(slice_side)}
                                                 : ArcEnd{to_low, low_side};
    strip.AddSlab(cuts[i], cuts[i + 1],
                  OccludedDirections(along, low, {to_high, high_side}, point));
  }
  return occluded;
}

}  // namespace farhorizon
