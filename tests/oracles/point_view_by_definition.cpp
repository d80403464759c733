// The union of the blocked directions around one point, exactly.
// Directions are those of undirected lines, so the circle of directions is the half-open upper half
// plane: 0 (the positive x axis) included, 180 degrees (the same line) not.

#include "tests/oracles/point_view_by_definition.h"

#include <algorithm>
#include <bit>
#include <optional>

namespace farhorizon::oracle {
namespace {

/// Coordinate holds the vectors at one sample, Product what two of them multiply to.
template <typename Coordinate, typename Product>
class Sample {
 public:
  Sample(const SightProblem& problem, const DyadicNumber& t)
      : problem_(problem),
        t_(t),
        numerator_(static_cast<Coordinate>(t.numerator)),
        denominator_(Coordinate(1) << static_cast<unsigned>(t.exponent)),
        level_(At(problem.z0, problem.z1)) {}

  LineVerdict LookAround() {
    for (std::size_t i = 0; i < problem_.obstacles.size(); ++i) {
      std::optional<LineVerdict> decided = Add(i);
      if (decided) return *std::move(decided);
    }
    return Cover();
  }

 private:
  struct Vector {
    Coordinate x;
    Coordinate y;
  };

  /// A stretch of [0, 180] degrees.
  struct Stretch {
    Vector from;
    Vector to;
    bool from_start;  ///< from 0 degrees, whatever `from` says
    bool to_end;      ///< to 180 degrees
    CoverLink link;
  };

  Coordinate At(std::int64_t constant, std::int64_t slope) const {
    return Coordinate(constant) * denominator_ + Coordinate(slope) * numerator_;
  }
  Vector At(const MovingVector64& v) const { return {At(v.x0, v.x1), At(v.y0, v.y1)}; }

  static int CrossSign(const Vector& v, const Vector& w) {
    const Product left = Product(v.x) * w.y;
    const Product right = Product(v.y) * w.x;
    return left < right ? -1 : (left > right ? 1 : 0);
  }
  static int DotSign(const Vector& v, const Vector& w) {
    const Product sum = Product(v.x) * w.x + Product(v.y) * w.y;
    return sum < 0 ? -1 : (sum > 0 ? 1 : 0);
  }
  static Vector Upper(const Vector& v) {
    if (v.y > 0 || (v.y == 0 && v.x > 0)) return v;
    return {-v.x, -v.y};
  }

  static LineVerdict Critical() { return {}; }

  /// Adds the directions that obstacle `i` blocks; a verdict where that settles the matter.
  std::optional<LineVerdict> Add(std::size_t i) {
    const Obstacle& f = problem_.obstacles[i];
    const Coordinate low = At(f.low_z, 0);
    const Coordinate high = At(f.high_z, 0);
    // An end that is passed in height: f's arc is about to appear, to vanish or to change its kind.
    if (problem_.z1 != 0 && (low == level_ || high == level_)) return Critical();
    const Vector to_low = At(f.to_low);
    const Vector to_high = At(f.to_high);
    const int side = CrossSign(to_low, to_high);
    if (side == 0) return InLine(i, DotSign(to_low, to_high));
    const bool level_ground = high == level_ && low == level_ && problem_.ties == Ties::kBlock;
    if (high <= level_ && !level_ground) return std::nullopt;
    const bool slice = low < level_;
    const Vector first = slice ? At(f.to_slice) : to_low;
    const CoverLink link{i, false, slice, side < 0};
    if (side > 0) {
      AddArc(first, to_high, link);
    } else {
      AddArc(to_high, first, link);
    }
    return std::nullopt;
  }

  /// The point lies on the line through obstacle `i`: inside it (dot < 0), at an end, or outside.
  std::optional<LineVerdict> InLine(std::size_t i, int dot) const {
    const Obstacle& f = problem_.obstacles[i];
    if (dot > 0) return std::nullopt;  // it blocks the one direction towards it, no arc
    if (dot == 0 || !f.parallel) return Critical();
    const Wide above =
        f.above.c0 * (Wide(1) << static_cast<unsigned>(t_.exponent)) + f.above.c1 * t_.numerator;
    const bool same = f.above.c0 == 0 && f.above.c1 == 0;
    if (above == 0 && !same) return Critical();
    if (above > 0 || (same && problem_.ties == Ties::kBlock)) {
      return LineVerdict{.kind = LineVerdict::Kind::kOccluded,
                         .cover = {{.obstacle = i, .over = true}}};
    }
    return std::nullopt;
  }

  void AddArc(const Vector& start, const Vector& end, const CoverLink& link) {
    const Vector from = Upper(start);
    const Vector to = Upper(end);
    if (CrossSign(from, to) > 0) {
      stretches_.push_back({from, to, false, false, link});
    } else {
      stretches_.push_back({from, to, false, true, link});
      stretches_.push_back({from, to, true, false, link});
    }
  }

  /// Walks from 0 to 180 degrees, always on by the stretch that reaches farthest.
  LineVerdict Cover() {
    std::sort(stretches_.begin(), stretches_.end(), [](const Stretch& a, const Stretch& b) {
      if (a.from_start != b.from_start) return a.from_start;
      if (!a.from_start && CrossSign(a.from, b.from) != 0) return CrossSign(a.from, b.from) > 0;
      return a.link.obstacle < b.link.obstacle;
    });
    LineVerdict verdict{.kind = LineVerdict::Kind::kOccluded};
    Vector reached{1, 0};
    std::size_t next = 0;
    const Stretch* farthest = nullptr;
    for (;;) {
      for (; next < stretches_.size(); ++next) {
        const Stretch& s = stretches_[next];
        if (!s.from_start && CrossSign(s.from, reached) < 0) break;
        if (farthest == nullptr || Farther(s, *farthest)) farthest = &s;
      }
      if (farthest == nullptr || (!farthest->to_end && CrossSign(reached, farthest->to) <= 0)) {
        return Free(reached, next);
      }
      verdict.cover.push_back(farthest->link);
      if (farthest->to_end) return verdict;
      reached = farthest->to;
    }
  }

  /// Nothing between `reached` and the next stretch, or 180 degrees where there is none.
  LineVerdict Free(const Vector& reached, std::size_t next) const {
    const Vector to = next < stretches_.size() ? stretches_[next].from : Vector{-1, 0};
    return {.kind = LineVerdict::Kind::kFree,
            .gap = {Wide(reached.x), Wide(reached.y), Wide(to.x), Wide(to.y)}};
  }

  static bool Farther(const Stretch& a, const Stretch& b) {
    if (a.to_end || b.to_end) return a.to_end && !b.to_end;
    return CrossSign(b.to, a.to) > 0;
  }

  const SightProblem& problem_;
  const DyadicNumber& t_;
  Coordinate numerator_;
  Coordinate denominator_;
  Coordinate level_;
  std::vector<Stretch> stretches_;
};

}  // namespace

LineVerdict LookAround(const SightProblem& problem, const DyadicNumber& t) {
  const int bits = static_cast<int>(std::bit_width(static_cast<std::uint64_t>(problem.largest)));
  // constant * 2^k + slope * numerator, numerator < 2^k: one bit more than the larger of the two.
  if (bits + t.exponent + 1 <= 62) return Sample<std::int64_t, __int128>(problem, t).LookAround();
  return Sample<Wide, Wide>(problem, t).LookAround();
}

}  // namespace farhorizon::oracle
