// By divide and conquer: the envelopes of two halves are merged from left to right. Where a piece
// of each covers a range of offsets, the sign of a linear form K b + C in the offset b tells which
// one is higher; it changes at one offset at most. With n the extent of a segment in offsets, m its
// rise, b1 and z1 the offset and height of its start,
//   K = m1 n2 - m2 n1   and   C = n1 n2 (z1 - z2) - b1 m1 n2 + b2 m2 n1.
// The same form with nearness for height tells which one is in front. By the limits |b| <= 2^39,
// n <= 2^40 and m <= 2^40, so that |K| < 2^81 and |C| < 2^122.
#include "core/horizon/lines_of_sight/upper_envelope.h"

#include <utility>

namespace farhorizon {

namespace {

using Envelope = std::vector<EnvelopePiece>;

// A quantity that is linear in the offset along a segment: `start` at the offset `at`, and by
// `rise` more `run` > 0 offsets further.
struct LinearForm {
  std::int64_t at = 0;
  std::int64_t run = 1;
  std::int64_t start = 0;
  std::int64_t rise = 0;
};

// A segment in projection along the view.
struct ProjectedSegment {
  LinearForm height;
  LinearForm nearness;
};

ProjectedSegment Project(Segment s, const ViewDirection& view) {
  if (Offset(s.a, view) > Offset(s.b, view)) std::swap(s.a, s.b);
  const std::int64_t at = Offset(s.a, view);
  const std::int64_t run = Offset(s.b, view) - at;
  const std::int64_t near_a = -Depth(s.a, view);
  const std::int64_t near_b = -Depth(s.b, view);
  return {{at, run, s.a.z, std::int64_t{s.b.z} - s.a.z}, {at, run, near_a, near_b - near_a}};
}

// K b + C: the difference of two linear forms at the offset b, times a positive number.
struct Difference {
  Int128 k;
  Int128 c;

  Difference(const LinearForm& p, const LinearForm& q)
      : k(Int128{p.rise} * q.run - Int128{q.rise} * p.run),
        c(Int128{p.run} * q.run * (p.start - q.start) - Int128{p.at} * p.rise * q.run +
          Int128{q.at} * q.rise * p.run) {}

  [[nodiscard]] bool IsZero() const { return k == 0 && c == 0; }
  [[nodiscard]] int SignAt(const Fraction& offset) const {
    return CompareProducts(k, offset.numerator, -c, offset.denominator);
  }
  // Requires: k is not 0.
  [[nodiscard]] Fraction Root() const { return k > 0 ? Fraction{-c, k} : Fraction{c, -k}; }
};

class Merger {
 public:
  explicit Merger(const std::vector<ProjectedSegment>& projected) : projected_(projected) {}

  Envelope Merge(Envelope left, Envelope right) {
    std::size_t i = 0;
    std::size_t j = 0;
    while (i < left.size() && j < right.size()) {
      EnvelopePiece& p = left[i];
      EnvelopePiece& q = right[j];
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
  // Moves a piece to the envelope up to the offset `next`, or to its end if that comes first.
  void TakeAlone(EnvelopePiece& piece, const Fraction& next) {
    const Fraction to = Compare(piece.to, next) < 0 ? piece.to : next;
    Append({piece.segment, piece.from, to});
    piece.from = to;
  }

  // Moves the higher of two pieces that start at one offset, up to the first end of one of them.
  void TakeBoth(EnvelopePiece& p, EnvelopePiece& q) {
    const Fraction from = p.from;
    const Fraction to = Compare(p.to, q.to) < 0 ? p.to : q.to;
    p.from = q.from = to;
    const ProjectedSegment& a = projected_[p.segment];
    const ProjectedSegment& b = projected_[q.segment];
    Difference difference(a.height, b.height);
    if (difference.IsZero()) difference = Difference(a.nearness, b.nearness);
    const int at_start = difference.SignAt(from);
    const int at_end = difference.SignAt(to);
    if (at_start * at_end >= 0) {
      const bool second = at_start + at_end < 0;
      Append({second ? q.segment : p.segment, from, to});
      return;
    }
    const Fraction crossing = difference.Root();
    Append({at_start > 0 ? p.segment : q.segment, from, crossing});
    Append({at_start > 0 ? q.segment : p.segment, crossing, to});
  }

  void Append(const EnvelopePiece& piece) {
    if (!merged_.empty() && merged_.back().segment == piece.segment &&
        Compare(merged_.back().to, piece.from) == 0) {
      merged_.back().to = piece.to;
    } else {
      merged_.push_back(piece);
    }
  }

  const std::vector<ProjectedSegment>& projected_;
  Envelope merged_;
};

}  // namespace

std::vector<EnvelopePiece> UpperEnvelope(std::span<const Segment> segments,
                                         const ViewDirection& view) {
  std::vector<ProjectedSegment> projected;
  projected.reserve(segments.size());
  std::vector<Envelope> envelopes;
  envelopes.reserve(segments.size());
  for (std::size_t i = 0; i < segments.size(); ++i) {
    projected.push_back(Project(segments[i], view));
    const LinearForm& height = projected.back().height;
    if (height.run == 0) continue;
    envelopes.push_back({{i, {height.at, 1}, {height.at + height.run, 1}}});
  }
  if (envelopes.empty()) return {};
  Merger merger(projected);
  for (std::size_t step = 1; step < envelopes.size(); step *= 2) {
    for (std::size_t i = 0; i + step < envelopes.size(); i += 2 * step) {
      envelopes[i] = merger.Merge(std::move(envelopes[i]), std::move(envelopes[i + step]));
    }
  }
  return std::move(envelopes.front());
}

}  // namespace farhorizon
