// One point of a segment, asked in the smallest of three sizes of numbers that hold it. Nearly all
// points have few bits. A view counts t from the lower end of the segment, a witness from its
// first end; MakeWitness converts one into the other.
#include "core/horizon/visibility/point_query.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace farhorizon {

namespace {

constexpr int kDoubleBits = 53;     // of integers that a double holds exactly
constexpr int kDirectionBits = 62;  // of a witness's direction (witness.h)

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

// t counted from the segment's first end, in lowest terms.
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
Witness MakeWitness(bool from_high, const BasicDyadic<Int>& t, const BasicVector<Int>& direction) {
  const BasicDyadic<Int> where = FromFirstEnd(from_high, t);
  const int excess =
      std::max({BitsOf(direction.x), BitsOf(direction.y), kDirectionBits}) - kDirectionBits;
  return {where.ToDouble(), static_cast<std::int64_t>(direction.x >> excess),
          static_cast<std::int64_t>(direction.y >> excess),
          BitsOf(where.n) <= kDoubleBits && excess == 0};
}

// Half way from one direction to another, which is counter-clockwise of it by half a turn at most.
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
  // Opposite vectors, whose sum is what rounding leaves, below 2^-51: half way is a quarter turn
  // on. Any limit is sound, as the middle is only where a search in doubles begins. Below this one
  // the sum has lost more than half of its digits.
  constexpr double kOpposite = 1e-9;
  if (std::hypot(sum[0], sum[1]) < kOpposite) return {-u[1], u[0]};
  return sum;
}

}  // namespace

bool IsPlain(const Witness& witness) {
  return witness.exact && DirectionBits(witness) <= kDoubleBits;
}

bool IsSimpler(const Witness& a, const Witness& b) {
  if (a.exact != b.exact) return a.exact;
  return DirectionBits(a) < DirectionBits(b);
}

PointQuery::PointQuery(const SegmentIndex& index, const VisibilityQuery& query)
    : index_(index),
      query_(query),
      from_high_(query.segment.a.z > query.segment.b.z),
      target_{query.segment.a, query.segment.b, query.ties},
      short_view_(index, target_, query, &counts_),
      likely_(query.hints.likely.begin(), query.hints.likely.end()) {
  if (from_high_) std::swap(target_.low, target_.high);
}

PointAnswer PointQuery::AnswerAt(const WideDyadic& t) {
  if (t.k <= kMaxShortBits) {
    return AnswerFrom(short_view_, ShortDyadic{static_cast<std::int64_t>(t.n), t.k});
  }
  if (t.k <= kMaxDyadicBits) {
    PointView view(index_, target_, query_, &counts_);
    return AnswerFrom(view, Narrowed(t));
  }
  WidePointView view(index_, target_, query_, &counts_);
  return AnswerFrom(view, t);
}

bool PointQuery::FitsDouble(const WideDyadic& t) const {
  return BitsOf(FromFirstEnd(from_high_, t).n) <= kDoubleBits;
}

template <typename Int>
PointAnswer PointQuery::AnswerFrom(BasicPointView<Int>& view, const BasicDyadic<Int>& t) {
  occluders_.clear();
  const PointOutcome outcome = view.Evaluate(t, likely_);
  if (outcome == PointOutcome::kGaveUp) return {.gave_up = true};
  if (outcome == PointOutcome::kVisible) {
    return {.witness = MakeWitness(from_high_, t, view.direction()),
            .free_direction = MiddleOf(view.free_arc().from, view.free_arc().to)};
  }
  const OccludedRange occluded = OccludedRangeAround(view, occluders_);
  // Occluders of one point are likely to occlude the next.
  if (!occluders_.empty()) likely_ = occluders_;
  return {.occluded = occluded};
}

}  // namespace farhorizon
