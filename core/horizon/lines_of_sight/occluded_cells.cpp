// What an obstacle hides of an edge lies between two curves, the directions to its lower end, or to where it
// rises through the point's height, and to its upper end: an arc whose ends move with t.
#include "core/horizon/lines_of_sight/occluded_cells.h"

#include <numeric>
#include <utility>

namespace farhorizon {
namespace {

using Kind = BoundaryCurve::Kind;

void Append(std::vector<IsolatedRoot>& roots, const std::vector<IsolatedRoot>& more) {
  roots.insert(roots.end(), more.begin(), more.end());
}

// One end of what is hidden of an obstacle at one point: its vector and its side of the edge's line.
struct ArcEnd {
  MovingVector v;
  int side;
};

// The curve of an arc's end, in the half turn. A vector that never turns, as those to what shares a post
// with the edge, is made a constant one: then it is nowhere zero, and equal to others of its direction.
// (It may be zero at one t, and opposite beyond, where what it points to is only the obstacle's line.)
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

// What an arc hides of the half turn, as pairs of curves.
std::vector<std::pair<BoundaryCurve, BoundaryCurve>> HalfTurnPart(const MovingVector& along,
                                                                  const ArcEnd& a, const ArcEnd& b,
                                                                  const SamplePoint& point) {
  if (a.side == 0 && b.side == 0) return {};  // in line with the edge: one direction
  if (a.side == 0 || b.side == 0) {
    const ArcEnd& on_line = a.side == 0 ? a : b;
    const ArcEnd& other = a.side == 0 ? b : a;
    const bool ahead = point.Sign(Dot(along, on_line.v)) * other.side > 0;
    if (ahead) return {{BoundaryCurve::Along(), CurveOf(along, other)}};
    return {{CurveOf(along, other), BoundaryCurve::Against()}};
  }
  BoundaryCurve first = CurveOf(along, a);
  BoundaryCurve last = CurveOf(along, b);
  const int turn = Order(first, last, point);
  if (turn == 0) return {};
  if (turn < 0) std::swap(first, last);
  if (a.side == b.side) return {{first, last}};
  // Across the edge's line, ahead of the point or behind it: all but what is between the two.
  return {{BoundaryCurve::Along(), first}, {last, BoundaryCurve::Against()}};
}

}  // namespace

std::vector<StripCell> CellsOccludedBy(const SegmentIndex::Item& item, const TargetSegment& edge) {
  const MovingVector along{std::int64_t{edge.high.x} - edge.low.x,
                           std::int64_t{edge.high.y} - edge.low.y, 0, 0};
  const Int128 climb = Int128{edge.high.z} - edge.low.z;
  const Quadratic under_top{Int128{item.high.z} - edge.low.z, -climb, 0};
  const Quadratic over_foot{Int128{edge.low.z} - item.low.z, climb, 0};
  const MovingVector to_low = ToPoint(edge, item.low);
  const MovingVector to_high = ToPoint(edge, item.high);
  const bool sliced_somewhere = over_foot.c0 + over_foot.c1 > 0;
  const MovingVector to_slice =
      sliced_somewhere && item.low.z < item.high.z ? ToSlice(edge, item.low, item.high) : to_low;
  const Quadratic slice_side = Cross(along, to_slice);

  std::vector<IsolatedRoot> roots = SignChanges(under_top);
  Append(roots, SignChanges(over_foot));
  if (sliced_somewhere) Append(roots, SignChanges(slice_side));
  Append(roots, SignChanges(Cross(to_low, to_high)));
  const std::vector<IsolatedRoot> cuts =
      Cuts(IsolatedRoot::Zero(), std::move(roots), IsolatedRoot::One());

  std::vector<StripCell> hidden;
  StripBuilder strip(hidden);
  const int low_side = SignOf(Cross(along, to_low).c0);
  const int high_side = SignOf(Cross(along, to_high).c0);
  for (std::size_t i = 0; i + 1 < cuts.size(); ++i) {
    const SamplePoint point = PointBetween(cuts[i], cuts[i + 1]);
    if (point.Sign(under_top) <= 0) {
      strip.Add(cuts[i], cuts[i + 1], {});
      continue;
    }
    const ArcEnd low = point.Sign(over_foot) > 0 ? ArcEnd{to_slice, point.Sign(slice_side)}
                                                 : ArcEnd{to_low, low_side};
    strip.Add(cuts[i], cuts[i + 1], HalfTurnPart(along, low, {to_high, high_side}, point));
  }
  return hidden;
}

}  // namespace farhorizon
