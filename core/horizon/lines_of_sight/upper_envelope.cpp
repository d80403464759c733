// By divide and conquer. Over a stretch across the view on which two segments show, which of them wins is
// the sign of K b + C, b the place across: with n the extent of a segment across and m its rise,
// K = m1 n2 - m2 n1 and C = n1 n2 (z1 - z2) - b1 m1 n2 + b2 m2 n1. The same form with nearness for height
// says which one is in front. By the limits |b| <= 2^39, n <= 2^40, m <= 2^40: K < 2^81, C < 2^122.
#include "core/horizon/lines_of_sight/upper_envelope.h"

#include <utility>

namespace farhorizon {
namespace {

using Parts = std::vector<EnvelopePart>;

// A quantity that changes linearly along a segment as it is seen: `start` at the place `at`, more by `rise`
// over `run` > 0 places.
struct SeenLine {
  std::int64_t at = 0;
  std::int64_t run = 1;
  std::int64_t start = 0;
  std::int64_t rise = 0;
};

struct SeenSegment {
  SeenLine height;
  SeenLine nearness;
};

SeenSegment Seen(Segment s, const ViewDirection& view) {
  if (Across(s.a, view) > Across(s.b, view)) std::swap(s.a, s.b);
  const std::int64_t at = Across(s.a, view);
  const std::int64_t run = Across(s.b, view) - at;
  const std::int64_t near_a = -Depth(s.a, view);
  const std::int64_t near_b = -Depth(s.b, view);
  return {{at, run, s.a.z, std::int64_t{s.b.z} - s.a.z}, {at, run, near_a, near_b - near_a}};
}

// K b + C: what one line has more than another at the place b, times a positive number.
struct Lead {
  Int128 k;
  Int128 c;

  Lead(const SeenLine& p, const SeenLine& q)
      : k(Int128{p.rise} * q.run - Int128{q.rise} * p.run),
        c(Int128{p.run} * q.run * (p.start - q.start) - Int128{p.at} * p.rise * q.run +
          Int128{q.at} * q.rise * p.run) {}

  [[nodiscard]] bool IsNone() const { return k == 0 && c == 0; }
  [[nodiscard]] int SignAt(const Fraction& place) const {
    return CompareProducts(k, place.numerator, -c, place.denominator);
  }
  [[nodiscard]] Fraction Root() const { return k > 0 ? Fraction{-c, k} : Fraction{c, -k}; }
};

class Merger {
 public:
  explicit Merger(const std::vector<SeenSegment>& seen) : seen_(seen) {}

  Parts Merge(Parts left, Parts right) {
    std::size_t i = 0;
    std::size_t j = 0;
    while (i < left.size() && j < right.size()) {
      EnvelopePart& p = left[i];
      EnvelopePart& q = right[j];
      const int starts = Compare(p.from, q.from);
      if (starts < 0) {
        TakeAlone(p, q.from);
      } else if (starts > 0) {
        TakeAlone(q, p.from);
      } else {
        TakeBoth(p, q);
      }
      if (Compare(p.from, p.to) >= 0) ++i;
      if (Compare(q.from, q.to) >= 0) ++j;
    }
    for (; i < left.size(); ++i) Append(left[i]);
    for (; j < right.size(); ++j) Append(right[j]);
    return std::exchange(merged_, {});
  }

 private:
  // Moves the start of `part` to `next`, or its end if that comes first.
  void TakeAlone(EnvelopePart& part, const Fraction& next) {
    const Fraction to = Compare(part.to, next) < 0 ? part.to : next;
    Append({part.segment, part.from, to});
    part.from = to;
  }

  // The same where two parts start at one place, up to the end of one of them.
  void TakeBoth(EnvelopePart& p, EnvelopePart& q) {
    const Fraction from = p.from;
    const Fraction to = Compare(p.to, q.to) < 0 ? p.to : q.to;
    p.from = q.from = to;
    const SeenSegment& a = seen_[p.segment];
    const SeenSegment& b = seen_[q.segment];
    Lead lead(a.height, b.height);
    if (lead.IsNone()) lead = Lead(a.nearness, b.nearness);
    const int at_start = lead.SignAt(from);
    const int at_end = lead.SignAt(to);
    if (at_start * at_end >= 0) {
      const bool second = at_start + at_end < 0;
      Append({second ? q.segment : p.segment, from, to});
      return;
    }
    const Fraction crossing = lead.Root();
    Append({at_start > 0 ? p.segment : q.segment, from, crossing});
    Append({at_start > 0 ? q.segment : p.segment, crossing, to});
  }

  void Append(const EnvelopePart& part) {
    if (!merged_.empty() && merged_.back().segment == part.segment &&
        Compare(merged_.back().to, part.from) == 0) {
      merged_.back().to = part.to;
    } else {
      merged_.push_back(part);
    }
  }

  const std::vector<SeenSegment>& seen_;
  Parts merged_;
};

}  // namespace

std::vector<EnvelopePart> UpperEnvelope(std::span<const Segment> segments,
                                        const ViewDirection& view) {
  std::vector<SeenSegment> seen;
  seen.reserve(segments.size());
  std::vector<Parts> runs;
  runs.reserve(segments.size());
  for (std::size_t i = 0; i < segments.size(); ++i) {
    seen.push_back(Seen(segments[i], view));
    const SeenLine& line = seen.back().height;
    if (line.run != 0) runs.push_back({{i, {line.at, 1}, {line.at + line.run, 1}}});
  }
  if (runs.empty()) return {};
  Merger merger(seen);
  for (std::size_t step = 1; step < runs.size(); step *= 2) {
    for (std::size_t i = 0; i + step < runs.size(); i += 2 * step) {
      runs[i] = merger.Merge(std::move(runs[i]), std::move(runs[i + step]));
    }
  }
  return std::move(runs.front());
}

}  // namespace farhorizon
