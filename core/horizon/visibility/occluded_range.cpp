#include "core/horizon/visibility/occluded_range.h"

#include <algorithm>
#include <optional>

#include "core/base/result.h"

namespace farhorizon {
namespace {

// Points in the numbers that roots are compared with.
Dyadic ForRoots(const ShortDyadic& t) { return {t.n, t.k}; }
Dyadic ForRoots(const Dyadic& t) { return t; }
WideDyadic ForRoots(const WideDyadic& t) { return t; }

// Narrows a range around t to where polynomials that are not negative at t stay so.
template <typename Point>
class RangeNarrower {
 public:
  explicit RangeNarrower(const Point& t)
      : t_(t), range_{QuadraticRoot::At(Dyadic{0, 0}), QuadraticRoot::At(Dyadic{1, 0})} {}

  void Keep(const Quadratic& q) {
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

// Heights: the point at t is not above the obstacle's top, and not past its lower end on the side
// that the arc was made for.
template <typename Int, typename Point>
void KeepHeights(const TargetSegment& e, const BasicArc<Int>& arc, RangeNarrower<Point>& narrower) {
  if (arc.obstacle == kFaces) return;
  const Int128 climb = Int128{e.high.z} - e.low.z;
  narrower.Keep({Int128{arc.high_z} - e.low.z, -climb, 0});
  if (arc.sliced) {
    narrower.Keep({Int128{e.low.z} - arc.low_z, climb, 0});
  } else {
    narrower.Keep({Int128{arc.low_z} - e.low.z, -climb, 0});
  }
}

// A chain of arcs that covers the half turn; the first contains the start, or begins at it.
template <typename Int>
std::vector<const BasicArc<Int>*> Thin(const std::vector<BasicArc<Int>>& arcs,
                                       PredicateCounts* counts) {
  using Arc = BasicArc<Int>;
  const auto at_start = [](const Arc& arc) {
    return arc.crosses_start || SignOf(arc.from_direction.v.y) == 0;
  };
  const auto ends_later = [counts](const Arc* a, const Arc* b) {
    if (a->crosses_start != b->crosses_start) return a->crosses_start;
    return CompareAngle(a->to_direction, b->to_direction, counts) > 0;
  };
  std::vector<const Arc*> by_start;
  const Arc* first = nullptr;
  for (const Arc& arc : arcs) {
    if (at_start(arc) &&
        (first == nullptr || CompareAngle(arc.to_direction, first->to_direction, counts) > 0)) {
      first = &arc;
    }
    by_start.push_back(&arc);
  }
  Check(first != nullptr, "some arc of a cover contains the start");
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
    Check(best != nullptr, "a cover has an arc that goes on where another ends");
    chain.push_back(best);
  }
}

// Cross products with each vector taken in the sense that its direction had at t.
Quadratic CrossOf(const MovingVector& a, bool a_turned, const MovingVector& b, bool b_turned) {
  const Quadratic cross = Cross(a, b);
  return a_turned == b_turned ? cross : Negated(cross);
}

template <typename Int, typename Point>
void KeepChain(const std::vector<const BasicArc<Int>*>& chain, RangeNarrower<Point>& narrower) {
  using Arc = BasicArc<Int>;
  for (const Arc* arc : chain) narrower.Keep(Cross(arc->from, arc->to));
  for (std::size_t i = 0; i + 1 < chain.size(); ++i) {
    // The next begins no later than this one ends, both in the upper half plane.
    narrower.Keep(CrossOf(chain[i + 1]->from, chain[i + 1]->from_direction.turned, chain[i]->to,
                          chain[i]->to_direction.turned));
  }
  const Arc& first = *chain.front();
  const Arc& last = *chain.back();
  // Around the start: the last one's end, half a turn on if it crosses, against the first one's
  // beginning, half a turn on if that one does not cross.
  const bool half_turn_apart = last.crosses_start == first.crosses_start;
  const Quadratic closing =
      CrossOf(first.from, first.from_direction.turned, last.to, last.to_direction.turned);
  if (first.crosses_start) {
    narrower.Keep(half_turn_apart ? Negated(closing) : closing);
  } else {
    narrower.Keep(closing);
  }
}

}  // namespace

template <typename Int>
OccludedRange OccludedRangeAround(const TargetSegment& target, const BasicPointView<Int>& sample,
                                  PointOutcome outcome, const BasicDyadic<Int>& at,
                                  std::vector<std::int32_t>* blockers, PredicateCounts* counts) {
  using Arc = BasicArc<Int>;
  const auto& t = ForRoots(at);
  if (outcome == PointOutcome::kAmbiguous) {
    return {QuadraticRoot::At(t), QuadraticRoot::At(t)};
  }
  RangeNarrower narrower(t);
  if (outcome == PointOutcome::kEnclosed) {
    const Arc& arc = sample.arcs().front();
    KeepHeights(target, arc, narrower);
    if (!arc.from.IsZero()) narrower.Keep(Negated(Dot(arc.from, arc.to)));
    if (blockers != nullptr && arc.obstacle >= 0) blockers->push_back(arc.obstacle);
    return narrower.range();
  }
  const std::vector<const Arc*> chain = Thin(sample.arcs(), counts);
  for (const Arc* arc : chain) {
    KeepHeights(target, *arc, narrower);
    if (blockers != nullptr && arc->obstacle >= 0) blockers->push_back(arc->obstacle);
  }
  KeepChain(chain, narrower);
  return narrower.range();
}

template OccludedRange OccludedRangeAround(const TargetSegment&, const ShortPointView&,
                                           PointOutcome, const ShortDyadic&,
                                           std::vector<std::int32_t>*, PredicateCounts*);
template OccludedRange OccludedRangeAround(const TargetSegment&, const PointView&, PointOutcome,
                                           const Dyadic&, std::vector<std::int32_t>*,
                                           PredicateCounts*);
template OccludedRange OccludedRangeAround(const TargetSegment&, const WidePointView&, PointOutcome,
                                           const WideDyadic&, std::vector<std::int32_t>*,
                                           PredicateCounts*);

}  // namespace farhorizon
