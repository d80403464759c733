// Whether a segment can be sighted over a set of others.
// Its points are asked one at a time: a point in sight answers the question; a point that is hidden
// is hidden together with a whole range around it, as far as the obstacles that hide it go on doing
// so. What the ranges leave open is asked next. Ranges end at roots of quadratics, compared
// exactly, so that ranges which only just meet do meet; each range ends at a real change of what
// hides the segment, of which there are finitely many.
#include "core/horizon/skyline.h"

#include <algorithm>
#include <utility>

#include "core/base/result.h"
#include "core/exact/quadratic.h"
#include "core/horizon/cover_certificate.h"
#include "core/horizon/segment_index.h"
#include "core/horizon/sight_sample.h"

namespace farhorizon {
namespace {

// What WitnessHolds can check in 128 bits; cliffs of 2^30 quanta stay below it.
constexpr int kMostWitnessBits = 107;

Witness MakeWitness(const Segment& segment, Dyadic t, const Vector& sight) {
  // Finer than a double can say would be a sight through a gap of 2^-52 of the segment.
  Check(t.k <= 52, "a witness stands at a number that a double can hold");
  const bool from_low = segment.a.z <= segment.b.z;
  const double where = from_low ? t.ToDouble() : 1 - t.ToDouble();
  const auto bits = [](Int128 value) {
    int count = 0;
    for (Int128 rest = value < 0 ? -value : value; rest > 0; rest >>= 1) ++count;
    return count;
  };
  Check(2 * std::max(bits(sight.x), bits(sight.y)) + t.k <= kMostWitnessBits,
        "a line of sight has a direction in moderate integers");
  return {where, static_cast<std::int64_t>(sight.x), static_cast<std::int64_t>(sight.y)};
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
                                          std::optional<Id> except, std::vector<Id>* blockers,
                                          PredicateCounts* counts,
                                          std::span<const Segment> screens) const {
  Sighted sighted{segment.a, segment.b, ties};
  if (segment.a.z > segment.b.z) std::swap(sighted.low, sighted.high);
  SightSample sample(index_->segments, sighted, except, screens, counts);
  std::vector<HiddenRange> open = {{QuadraticRoot::At({0, 0}), QuadraticRoot::At({1, 0})}};
  while (!open.empty()) {
    const HiddenRange gap = open.back();
    open.pop_back();
    const std::optional<Dyadic> t = Between(gap.from, gap.to);
    if (!t) continue;
    const SightSample::Outcome outcome = sample.Look(*t);
    if (outcome == SightSample::Outcome::kSight) return MakeWitness(segment, *t, sample.sight());
    const HiddenRange hidden = RangeOfCover(sighted, sample, outcome, *t, blockers, counts);
    open.push_back({gap.from, hidden.from});
    open.push_back({hidden.to, gap.to});
  }
  return std::nullopt;
}

}  // namespace farhorizon
