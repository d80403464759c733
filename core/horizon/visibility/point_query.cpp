#include "core/horizon/visibility/point_query.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace farhorizon {
namespace {

// What a double holds exactly, here and in the JSON of others.
constexpr int kDoubleBits = 53;
constexpr int kDirectionBits = 62;

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

// t as it is counted from the segment's first end, in lowest terms.
template <typename Int>
BasicDyadic<Int> FromFirstEnd(bool from_high, const BasicDyadic<Int>& t) {
  BasicDyadic<Int> where = t;
  if (from_high) where.n = (Int{1} << t.k) - t.n;
  while (where.k > 0 && (where.n & Int{1}) == 0) {
    where = {where.n >> 1, where.k - 1};
  }
  return where;
}

template <typename Int>
Witness MakeWitness(bool from_high, const BasicDyadic<Int>& t, const BasicVector<Int>& sight) {
  const BasicDyadic<Int> where = FromFirstEnd(from_high, t);
  const int excess = std::max({BitsOf(sight.x), BitsOf(sight.y), kDirectionBits}) - kDirectionBits;
  return {where.ToDouble(), static_cast<std::int64_t>(sight.x >> excess),
          static_cast<std::int64_t>(sight.y >> excess),
          BitsOf(where.n) <= kDoubleBits && excess == 0};
}

// Half way between two directions, the second counter-clockwise of the first by half a turn at most.
template <typename Int>
std::array<double, 2> MiddleOf(const BasicVector<Int>& from, const BasicVector<Int>& to) {
  const auto unit = [](const BasicVector<Int>& v) {
    const auto x = static_cast<double>(v.x);
    const auto y = static_cast<double>(v.y);
    const double length = std::hypot(x, y);
    return std::array{x / length, y / length};
  };
  const std::array<double, 2> u = unit(from);
  const std::array<double, 2> v = unit(to);
  const std::array<double, 2> sum = {u[0] + v[0], u[1] + v[1]};
  // Opposite to each other: all directions, of which the middle is a quarter turn on.
  if (std::hypot(sum[0], sum[1]) < 1e-9) return {-u[1], u[0]};
  return sum;
}

}  // namespace

bool IsPlain(const Witness& witness) {
  return witness.exact && DirectionBits(witness) <= kDoubleBits;
}

bool Simpler(const Witness& a, const Witness& b) {
  if (a.exact != b.exact) return a.exact;
  return DirectionBits(a) < DirectionBits(b);
}

PointQuery::PointQuery(const SegmentIndex& index, const Segment& segment, Ties ties,
                       std::optional<std::int32_t> except, const OcclusionHints& hints,
                       std::vector<std::int32_t>* blockers, PredicateCounts* counts)
    : index_(index),
      from_high_(segment.a.z > segment.b.z),
      target_{segment.a, segment.b, ties},
      except_(except),
      hints_(hints),
      likely_(hints.likely.begin(), hints.likely.end()),
      blockers_(blockers),
      counts_(counts),
      short_sample_(index, target_, except, hints, counts) {
  if (from_high_) std::swap(target_.low, target_.high);
}

PointAnswer PointQuery::LookAt(const WideDyadic& t) {
  if (t.k <= kMaxShortBits) {
    return LookWith(short_sample_, ShortDyadic{static_cast<std::int64_t>(t.n), t.k});
  }
  if (t.k <= kMaxDyadicBits) {
    PointView sample(index_, target_, except_, hints_, counts_);
    return LookWith(sample, Narrowed(t));
  }
  WidePointView sample(index_, target_, except_, hints_, counts_);
  return LookWith(sample, t);
}

bool PointQuery::FitsDouble(const WideDyadic& t) const {
  return BitsOf(FromFirstEnd(from_high_, t).n) <= kDoubleBits;
}

template <typename Int>
PointAnswer PointQuery::LookWith(BasicPointView<Int>& sample, const BasicDyadic<Int>& t) {
  const PointOutcome outcome = sample.Look(t, likely_);
  if (outcome == PointOutcome::kVisible) {
    return {MakeWitness(from_high_, t, sample.sight()),
            MiddleOf(sample.gap().from, sample.gap().to),
            {}};
  }
  chain_.clear();
  const OccludedRange hidden = OccludedRangeAround(target_, sample, outcome, t, &chain_, counts_);
  if (blockers_ != nullptr) blockers_->insert(blockers_->end(), chain_.begin(), chain_.end());
  // What hides one point is likely to hide the next.
  if (!chain_.empty()) likely_ = chain_;
  return {std::nullopt, {}, hidden};
}

}  // namespace farhorizon
