// Whether a segment is visible over a set of others. The points of the segment are asked one at a
// time (core/horizon/README.md, theorems 8 and 9). A visible point answers the query. An occluded
// point is occluded together with a range around it, on which the same occluders go on covering all
// directions. Points that no range contains are asked next.
// Termination: each range ends at 0, at 1 or at a root of one of finitely many quadratics, and ends
// are compared exactly, so ranges that just touch leave no gap between them.
// A witness that a double and two 53-bit integers cannot represent is kept while a few more points
// are asked for a simpler one.
#include "core/horizon/visibility/visibility_query.h"

#include <deque>
#include <utility>

#include "core/exact/quadratic.h"
#include "core/horizon/visibility/point_query.h"

namespace farhorizon {

namespace {

// How many witnesses with long numbers are compared for the simplest one. Any value is sound: it
// only decides which witness is returned. This one is enough to reach the middle of the free
// directions around the first.
constexpr int kMostLongWitnesses = 32;

}  // namespace

Visibility FindLineOfSight(const SegmentIndex& segments, const VisibilityQuery& query) {
  PointQuery points(segments, query);
  Visibility answer;
  std::deque<OccludedRange> open = {
      {QuadraticRoot::At(Dyadic{0, 0}), QuadraticRoot::At(Dyadic{1, 0})}};
  int long_witnesses = 0;
  while (!open.empty() && long_witnesses < kMostLongWitnesses) {
    if (query.decision_limit && points.counts().Sum() >= *query.decision_limit) {
      answer.gave_up = true;
      break;
    }
    // The first witness is searched for depth first, a simpler one breadth first.
    const OccludedRange range = answer.witness ? open.front() : open.back();
    answer.witness ? open.pop_front() : open.pop_back();
    const std::optional<WideDyadic> t = Between(range.from, range.to);
    if (!t) continue;
    PointAnswer point = points.AnswerAt(*t);
    if (point.gave_up) {
      answer.gave_up = true;
      break;
    }
    if (point.witness) {
      const bool plain = IsPlain(*point.witness);
      if (plain || !answer.witness || IsSimpler(*point.witness, *answer.witness)) {
        answer.witness = point.witness;
      }
      if (plain) break;
      // t is the coarsest number in the range: where t has too many digits, all others have.
      if (!points.FitsDouble(*t) || t->k > kMaxDyadicBits) continue;
      ++long_witnesses;
      point.occluded = {QuadraticRoot::At(*t), QuadraticRoot::At(*t)};
    } else if (query.want_occluders) {
      answer.occluders.insert(answer.occluders.end(), points.occluders().begin(),
                              points.occluders().end());
    }
    open.push_back({range.from, point.occluded.from});
    open.push_back({point.occluded.to, range.to});
  }
  answer.counts = points.counts();
  return answer;
}

}  // namespace farhorizon
