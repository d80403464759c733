// Whether a segment can be sighted over a set of others.
// Its points are asked one at a time: a point in sight answers the question; a point that is hidden
// is hidden together with a whole range around it, as far as the obstacles that hide it go on doing
// so. What the ranges leave open is asked next. Ranges end at roots of quadratics, compared
// exactly, so that ranges which only just meet do meet; each range ends at a real change of what
// hides the segment, of which there are finitely many.
// A sight that cannot be said in plain numbers is kept while a few more points are asked for another.
#include "core/horizon/skyline.h"

#include <algorithm>
#include <deque>
#include <utility>

#include "core/base/result.h"
#include "core/exact/quadratic.h"
#include "core/horizon/cover_certificate.h"
#include "core/horizon/segment_index.h"
#include "core/horizon/sight_sample.h"

namespace farhorizon {
namespace {

// What a double holds exactly, here and in the JSON of others.
constexpr int kDoubleBits = 53;
constexpr int kDirectionBits = 62;
// How many sights in awkward directions are looked at for the simplest: enough to meet the middle of
// what is free around the first.
constexpr int kMostSights = 32;

// The bits of |value|.
template <typename Int>
int BitsOf(const Int& value) {
  int count = 0;
  for (Int rest = SignOf(value) < 0 ? -value : value; SignOf(rest) != 0; rest = rest >> 1) ++count;
  return count;
}

int DirectionBits(const Witness& witness) {
  return std::max(BitsOf(Int128{witness.dc}), BitsOf(Int128{witness.dr}));
}

bool IsPlain(const Witness& witness) {
  return witness.exact && DirectionBits(witness) <= kDoubleBits;
}

bool Simpler(const Witness& a, const Witness& b) {
  if (a.exact != b.exact) return a.exact;
  return DirectionBits(a) < DirectionBits(b);
}

// t as it is counted from a, in lowest terms.
template <typename Int>
BasicDyadic<Int> FromFirstEnd(const Segment& segment, const BasicDyadic<Int>& t) {
  BasicDyadic<Int> where = t;
  if (segment.a.z > segment.b.z) where.n = (Int{1} << t.k) - t.n;
  while (where.k > 0 && static_cast<std::int64_t>(where.n) % 2 == 0) {
    where = {where.n >> 1, where.k - 1};
  }
  return where;
}

bool FitsDouble(const Segment& segment, const WideDyadic& t) {
  return BitsOf(FromFirstEnd(segment, t).n) <= kDoubleBits;
}

template <typename Int>
Witness MakeWitness(const Segment& segment, const BasicDyadic<Int>& t,
                    const BasicVector<Int>& sight) {
  const BasicDyadic<Int> where = FromFirstEnd(segment, t);
  const int excess = std::max({BitsOf(sight.x), BitsOf(sight.y), kDirectionBits}) - kDirectionBits;
  return {where.ToDouble(), static_cast<std::int64_t>(sight.x >> excess),
          static_cast<std::int64_t>(sight.y >> excess),
          BitsOf(where.n) <= kDoubleBits && excess == 0};
}

// What one point of a segment told: a sight, or a range around it that is hidden.
struct Finding {
  std::optional<Witness> sight;
  HiddenRange hidden;
};

// Asks points of one segment, in the numbers that each needs.
class SightSearch {
 public:
  SightSearch(const SegmentIndex& index, const Segment& segment, Ties ties,
              std::optional<std::int32_t> except, const SightHints& hints,
              std::vector<std::int32_t>* blockers, PredicateCounts* counts)
      : index_(index),
        segment_(segment),
        sighted_{segment.a, segment.b, ties},
        except_(except),
        hints_(hints),
        likely_(hints.likely.begin(), hints.likely.end()),
        blockers_(blockers),
        counts_(counts),
        short_sample_(index, sighted_, except, hints, counts) {
    if (segment.a.z > segment.b.z) std::swap(sighted_.low, sighted_.high);
  }

  Finding LookAt(const WideDyadic& t) {
    if (t.k <= kMaxShortBits) {
      return LookWith(short_sample_, ShortDyadic{static_cast<std::int64_t>(t.n), t.k});
    }
    if (t.k <= kMaxDyadicBits) {
      SightSample sample(index_, sighted_, except_, hints_, counts_);
      return LookWith(sample, Narrowed(t));
    }
    WideSightSample sample(index_, sighted_, except_, hints_, counts_);
    return LookWith(sample, t);
  }

 private:
  template <typename Int>
  Finding LookWith(BasicSightSample<Int>& sample, const BasicDyadic<Int>& t) {
    const SightOutcome outcome = sample.Look(t, likely_);
    if (outcome == SightOutcome::kSight) return {MakeWitness(segment_, t, sample.sight()), {}};
    chain_.clear();
    const HiddenRange hidden = RangeOfCover(sighted_, sample, outcome, t, &chain_, counts_);
    if (blockers_ != nullptr) blockers_->insert(blockers_->end(), chain_.begin(), chain_.end());
    // What hides one point is likely to hide the next.
    if (!chain_.empty()) likely_ = chain_;
    return {std::nullopt, hidden};
  }

  const SegmentIndex& index_;
  const Segment& segment_;
  Sighted sighted_;
  std::optional<std::int32_t> except_;
  const SightHints& hints_;
  std::vector<std::int32_t> likely_;
  std::vector<std::int32_t> chain_;
  std::vector<std::int32_t>* blockers_;
  PredicateCounts* counts_;
  ShortSightSample short_sample_;
};

// Whether the decisions are past those that the limit allows; it is told so.
bool IsReached(SightLimit* limit, const PredicateCounts* counts, std::int64_t most) {
  if (limit == nullptr || counts == nullptr || counts->Sum() < most) return false;
  limit->reached = true;
  return true;
}

}  // namespace

struct Skyline::Index {
  SegmentIndex segments;
};

Skyline::Skyline(std::int32_t columns, std::int32_t rows)
    : index_(std::make_unique<Index>(Index{SegmentIndex(columns, rows)})) {}
Skyline::~Skyline() = default;
Skyline::Skyline(Skyline&&) noexcept = default;
Skyline& Skyline::operator=(Skyline&&) noexcept = default;

Skyline::Id Skyline::Insert(const Segment& segment) { return index_->segments.Insert(segment); }
void Skyline::Erase(Id id) { index_->segments.Erase(id); }
std::int64_t Skyline::size() const { return index_->segments.alive(); }

std::optional<Witness> Skyline::FindSight(const Segment& segment, Ties ties,
                                          std::optional<Id> except, const SightHints& hints,
                                          std::vector<Id>* blockers, PredicateCounts* counts,
                                          SightLimit* limit) const {
  SightSearch search(index_->segments, segment, ties, except, hints, blockers, counts);
  std::deque<HiddenRange> open = {
      {QuadraticRoot::At(Dyadic{0, 0}), QuadraticRoot::At(Dyadic{1, 0})}};
  std::optional<Witness> best;
  int sights = 0;
  Check(limit == nullptr || counts != nullptr, "what is limited is counted");
  const std::int64_t most =
      limit != nullptr && counts != nullptr ? counts->Sum() + limit->decisions : 0;
  while (!open.empty() && sights < kMostSights && !IsReached(limit, counts, most)) {
    // One sight is looked for in depth, a simpler one everywhere.
    const HiddenRange gap = best ? open.front() : open.back();
    best ? open.pop_front() : open.pop_back();
    const std::optional<WideDyadic> t = Between(gap.from, gap.to);
    if (!t) continue;
    Finding finding = search.LookAt(*t);
    if (finding.sight) {
      if (IsPlain(*finding.sight)) return finding.sight;
      if (!best || Simpler(*finding.sight, *best)) best = finding.sight;
      // This is the coarsest number in the gap: where it has too many digits, so have all others.
      if (!FitsDouble(segment, *t) || t->k > kMaxDyadicBits) continue;
      ++sights;
      finding.hidden = {QuadraticRoot::At(*t), QuadraticRoot::At(*t)};
    }
    open.push_back({gap.from, finding.hidden.from});
    open.push_back({finding.hidden.to, gap.to});
  }
  return best;
}

}  // namespace farhorizon
