// Whether a segment can be sighted over a set of others.
// Its points are asked one at a time: a point in sight answers the question; a point that is hidden
// is hidden together with a whole range around it, as far as the obstacles that hide it go on doing
// so. What the ranges leave open is asked next. Ranges end at roots of quadratics, compared
// exactly, so that ranges which only just meet do meet; each range ends at a real change of what
// hides the segment, of which there are finitely many.
// A sight that cannot be said in plain numbers is kept while a few more points are asked for another.
#include "core/horizon/visibility/occluder_set.h"

#include <deque>

#include "core/base/result.h"
#include "core/exact/quadratic.h"
#include "core/horizon/visibility/point_query.h"
#include "core/horizon/visibility/segment_index.h"

namespace farhorizon {
namespace {

// How many sights in awkward directions are looked at for the simplest: enough to meet the middle of
// what is free around the first.
constexpr int kMostSights = 32;

// Whether the decisions are past those that the limit allows; it is told so.
bool IsReached(DecisionLimit* limit, const PredicateCounts* counts, std::int64_t most) {
  if (limit == nullptr || counts == nullptr || counts->Sum() < most) return false;
  limit->reached = true;
  return true;
}

}  // namespace

struct OccluderSet::Index {
  SegmentIndex segments;
};

OccluderSet::OccluderSet(std::int32_t columns, std::int32_t rows)
    : index_(std::make_unique<Index>(Index{SegmentIndex(columns, rows)})) {}
OccluderSet::~OccluderSet() = default;
OccluderSet::OccluderSet(OccluderSet&&) noexcept = default;
OccluderSet& OccluderSet::operator=(OccluderSet&&) noexcept = default;

OccluderSet::Id OccluderSet::Insert(const Segment& segment) {
  return index_->segments.Insert(segment);
}
void OccluderSet::Erase(Id id) { index_->segments.Erase(id); }
std::int64_t OccluderSet::size() const { return index_->segments.alive(); }

std::optional<Witness> OccluderSet::FindLineOfSight(
    const Segment& segment, Ties ties, std::optional<Id> except, const OcclusionHints& hints,
    std::vector<Id>* blockers, PredicateCounts* counts, DecisionLimit* limit) const {
  PointQuery search(index_->segments, segment, ties, except, hints, blockers, counts);
  std::deque<OccludedRange> open = {
      {QuadraticRoot::At(Dyadic{0, 0}), QuadraticRoot::At(Dyadic{1, 0})}};
  std::optional<Witness> best;
  int sights = 0;
  Check(limit == nullptr || counts != nullptr, "what is limited is counted");
  const std::int64_t most =
      limit != nullptr && counts != nullptr ? counts->Sum() + limit->decisions : 0;
  while (!open.empty() && sights < kMostSights && !IsReached(limit, counts, most)) {
    // One sight is looked for in depth, a simpler one everywhere.
    const OccludedRange gap = best ? open.front() : open.back();
    best ? open.pop_front() : open.pop_back();
    const std::optional<WideDyadic> t = Between(gap.from, gap.to);
    if (!t) continue;
    PointAnswer finding = search.LookAt(*t);
    if (finding.sight) {
      if (IsPlain(*finding.sight)) return finding.sight;
      if (!best || Simpler(*finding.sight, *best)) best = finding.sight;
      // This is the coarsest number in the gap: where it has too many digits, so have all others.
      if (!search.FitsDouble(*t) || t->k > kMaxDyadicBits) continue;
      ++sights;
      finding.hidden = {QuadraticRoot::At(*t), QuadraticRoot::At(*t)};
    }
    open.push_back({gap.from, finding.hidden.from});
    open.push_back({finding.hidden.to, gap.to});
  }
  return best;
}

}  // namespace farhorizon
