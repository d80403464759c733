// A covered point is covered with its surroundings (core/horizon/README.md, theorem 9). Of the arcs
// that cover the half turn at t, a minimal chain is taken, each arc of which begins before the one
// before it ends:
//
//      start |----- directions counter-clockwise ----->| half a turn: the start again
//      ======1===>                                ======1    the first arc contains the start
//              ======2=====>
//                       ========3======>
//                                    =====4========>         the last one reaches the first
//
// The chain covers the half turn at every t at which these hold: each arc turns counter-clockwise
// (cross(from, to) >= 0), each arc's `from` is not beyond the `to` before it, each occluder is
// higher than the point, and the point is on the same side of the height of its lower end. Each
// condition is q(t) >= 0 for a polynomial q of degree two at most; the range is narrowed to where
// all of them hold. A vector is a boundary of the half turn in one of its two senses; the sense
// that it has at t is used for all t, so a vector that turns through the start changes no sign.
#include "core/horizon/visibility/occluded_range.h"

#include <algorithm>
#include <optional>

#include "core/base/result.h"

namespace farhorizon {

namespace {

// t in the numbers that roots are compared with.
Dyadic ForRoots(const ShortDyadic& t) { return {t.n, t.k}; }
Dyadic ForRoots(const Dyadic& t) { return t; }
WideDyadic ForRoots(const WideDyadic& t) { return t; }

// Narrows [0, 1] around t to where polynomials that are not negative at t stay so.
template <typename Point>
class RangeNarrower {
 public:
  explicit RangeNarrower(const Point& t)
      : t_(t), range_{QuadraticRoot::At(Dyadic{0, 0}), QuadraticRoot::At(Dyadic{1, 0})} {}

  void KeepNonNegative(const Quadratic& q) {
    if (BernsteinNonNegative(q)) return;
    const NonNegativeRange allowed = NonNegativeAround(q, t_);
    if (allowed.point) range_ = {QuadraticRoot::At(t_), QuadraticRoot::At(t_)};
    if (allowed.from && Compare(*allowed.from, Dyadic{0, 0}) > 0 &&
        Compare(*allowed.from, range_.from) > 0) {
      range_.from = *allowed.from;
    }
    if (allowed.to && Compare(*allowed.to, Dyadic{1, 0}) < 0 &&
        Compare(*allowed.to, range_.to) < 0) {
      range_.to = *allowed.to;
    }
  }

  [[nodiscard]] const OccludedRange& range() const { return range_; }

 private:
  Point t_;
  OccludedRange range_;
};

Quadratic Negated(const Quadratic& q) { return {-q.c0, -q.c1, -q.c2}; }

// The point is not above the occluder's upper end, and above or below its lower end as at t.
template <typename Int, typename Point>
void KeepHeightOrder(const TargetSegment& e, const BasicOccluderArc<Int>& arc,
                     RangeNarrower<Point>& narrower) {
  if (arc.occluder == kAdjacentFaces) return;
  const Int128 climb = Int128{e.high.z} - e.low.z;
  narrower.KeepNonNegative({Int128{arc.high_z} - e.low.z, -climb, 0});
  if (arc.sliced) {
    narrower.KeepNonNegative({Int128{e.low.z} - arc.low_z, climb, 0});
  } else {
    narrower.KeepNonNegative({Int128{arc.low_z} - e.low.z, -climb, 0});
  }
}

// Arcs that cover the half turn, each but the first beginning on the one before. The first contains
// the start, or begins there. Greedy: of the arcs that begin on the last one, the one that ends
// furthest is next.
template <typename Int>
std::vector<const BasicOccluderArc<Int>*> MinimalChain(
    const std::vector<BasicOccluderArc<Int>>& arcs, PredicateCounts* counts) {
  using Arc = BasicOccluderArc<Int>;
  const auto contains_start = [](const Arc& arc) {
    return arc.crosses_start || SignOf(arc.from_direction.v.y) == 0;
  };
  const auto ends_later = [counts](const Arc* a, const Arc* b) {
    if (a->crosses_start != b->crosses_start) return a->crosses_start;
    return CompareAngle(a->to_direction, b->to_direction, counts) > 0;
  };
  std::vector<const Arc*> by_start;
  const Arc* first = nullptr;
  for (const Arc& arc : arcs) {
    if (contains_start(arc) &&
        (first == nullptr || CompareAngle(arc.to_direction, first->to_direction, counts) > 0)) {
      first = &arc;
    }
    by_start.push_back(&arc);
  }
  Check(first != nullptr, "some arc contains the start where all directions are covered");
  std::sort(by_start.begin(), by_start.end(), [counts](const Arc* a, const Arc* b) {
    return CompareAngle(a->from_direction, b->from_direction, counts) < 0;
  });
  std::vector<const Arc*> chain = {first};
  std::size_t next = 0;
  while (true) {
    const BasicDirection<Int>& reached = chain.back()->to_direction;
    const bool closes =
        first->crosses_start && CompareAngle(reached, first->from_direction, counts) >= 0;
    if (closes || (chain.size() > 1 && chain.back()->crosses_start)) return chain;
    const Arc* best = nullptr;
    for (; next < by_start.size() &&
           CompareAngle(by_start[next]->from_direction, reached, counts) <= 0;
         ++next) {
      if (best == nullptr || ends_later(by_start[next], best)) best = by_start[next];
    }
    Check(best != nullptr, "some arc begins on the last one where all directions are covered");
    chain.push_back(best);
  }
}

// The cross product of two vectors, each taken in the sense that its direction has at t.
Quadratic CrossOf(const MovingVector& a, bool a_turned, const MovingVector& b, bool b_turned) {
  const Quadratic cross = Cross(a, b);
  return a_turned == b_turned ? cross : Negated(cross);
}

template <typename Int, typename Point>
void KeepChain(const std::vector<const BasicOccluderArc<Int>*>& chain,
               RangeNarrower<Point>& narrower) {
  using Arc = BasicOccluderArc<Int>;
  for (const Arc* arc : chain) narrower.KeepNonNegative(Cross(arc->from, arc->to));
  for (std::size_t i = 0; i + 1 < chain.size(); ++i) {
    // The next arc's `from` is not beyond this one's `to`; both directions are in the half turn.
    narrower.KeepNonNegative(CrossOf(chain[i + 1]->from, chain[i + 1]->from_direction.turned,
                                     chain[i]->to, chain[i]->to_direction.turned));
  }
  const Arc& first = *chain.front();
  const Arc& last = *chain.back();
  // Around the start: the first arc's `from` is not beyond the last one's `to`. Where the first arc
  // crosses the start, its `from` is before the half turn's end; where the last one crosses it, its
  // `to` is half a turn further on.
  const bool half_turn_apart = last.crosses_start == first.crosses_start;
  const Quadratic closing =
      CrossOf(first.from, first.from_direction.turned, last.to, last.to_direction.turned);
  if (first.crosses_start) {
    narrower.KeepNonNegative(half_turn_apart ? Negated(closing) : closing);
  } else {
    narrower.KeepNonNegative(closing);
  }
}

}  // namespace

template <typename Int>
OccludedRange OccludedRangeAround(const BasicPointView<Int>& view,
                                  std::vector<OccluderId>& occluders) {
  using Arc = BasicOccluderArc<Int>;
  const auto& t = ForRoots(view.t());
  if (view.outcome() == PointOutcome::kAmbiguous) {
    return {QuadraticRoot::At(t), QuadraticRoot::At(t)};
  }
  RangeNarrower narrower(t);
  if (view.outcome() == PointOutcome::kOccludedByOne) {
    const Arc& arc = view.arcs().front();
    KeepHeightOrder(view.target(), arc, narrower);
    // The point stays between the ends of the part that is above it.
    if (!arc.from.IsZero()) narrower.KeepNonNegative(Negated(Dot(arc.from, arc.to)));
    if (arc.occluder >= 0) occluders.push_back(arc.occluder);
    return narrower.range();
  }
  const std::vector<const Arc*> chain = MinimalChain(view.arcs(), view.counts());
  for (const Arc* arc : chain) {
    KeepHeightOrder(view.target(), *arc, narrower);
    if (arc->occluder >= 0) occluders.push_back(arc->occluder);
  }
  KeepChain(chain, narrower);
  return narrower.range();
}

template OccludedRange OccludedRangeAround(const ShortPointView&, std::vector<OccluderId>&);
template OccludedRange OccludedRangeAround(const PointView&, std::vector<OccluderId>&);
template OccludedRange OccludedRangeAround(const WidePointView&, std::vector<OccluderId>&);

}  // namespace farhorizon
