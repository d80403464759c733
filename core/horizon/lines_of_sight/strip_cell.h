#pragma once

#include <array>
#include <optional>
#include <utility>
#include <vector>

#include "core/exact/isolated_root.h"
#include "core/geometry/vector.h"
#include "core/horizon/visibility/moving_vector.h"

namespace farhorizon {

// The lines that meet an edge in plan, as points of a strip: t runs along the edge from its lower
// end (0) to its higher one (1), and directions turn counter-clockwise through the half turn from
// the edge's own direction to its opposite. A direction of sight has no sense, so each line through
// the inside of the edge is one point of the strip.
//
//      direction
//      kAgainst +----------------------------------+  half a turn: the edge's opposite
//               |               last               |
//               |        ___..---''''---..         |
//               |       |                 |        |
//               |       |    StripCell    |        |
//               |       |                 |        |
//               |       '--..__     __..--'        |
//               |              '''''               |
//               |               first              |
//        kAlong +----------------------------------+  0: the edge's own direction
//              t = 0   from              to      t = 1

/// A direction that depends on t: either end of the half turn, or a moving vector strictly between
/// the two.
struct BoundaryCurve {
  enum class Kind { kAlong, kMoving, kAgainst };
  Kind kind = Kind::kMoving;
  MovingVector v;

  static BoundaryCurve Along() { return {Kind::kAlong, {}}; }
  static BoundaryCurve Against() { return {Kind::kAgainst, {}}; }
  friend bool operator==(const BoundaryCurve&, const BoundaryCurve&) = default;
};

/// The lines with t in [from, to] and a direction from `first` counter-clockwise to `last`. At each
/// t strictly between `from` and `to`, first < last.
///
/// The curve of a moving vector a + b t turns one way only, that of the sign of cross(a, b). So the
/// directions of a cell, for all its t together, are those from the lesser end of `first` to the
/// greater end of `last`.
struct StripCell {
  IsolatedRoot from = IsolatedRoot::Zero();
  IsolatedRoot to = IsolatedRoot::One();
  BoundaryCurve first;
  BoundaryCurve last;
};

/// The vector at t, up to a positive factor, its angle within 2^-36 of the exact one. Requires: it
/// is one vector for all t, or its direction turns: cross(a, b) is not 0.
PlanVector DirectionAt(const MovingVector& v, const IsolatedRoot& t);

/// The directions from one curve counter-clockwise to another.
using CurvePair = std::pair<BoundaryCurve, BoundaryCurve>;

/// None, one or two of them.
class CurvePairs {
 public:
  CurvePairs() = default;
  CurvePairs(const BoundaryCurve& first, const BoundaryCurve& last) { Add(first, last); }

  /// Requires: there are no more than two.
  void Add(const BoundaryCurve& first, const BoundaryCurve& last) {
    pairs_[size_++] = {first, last};
  }
  [[nodiscard]] const CurvePair* begin() const { return pairs_.data(); }
  [[nodiscard]] const CurvePair* end() const { return pairs_.data() + size_; }

 private:
  std::array<CurvePair, 2> pairs_;
  std::size_t size_ = 0;
};

/// 1 where b is counter-clockwise of a around the point, -1 where it is clockwise, 0 where the two
/// are one direction for all t. Exact. Requires: they do not cross at the point; they may touch
/// there.
int Order(const BoundaryCurve& a, const BoundaryCurve& b, const SamplePoint& point);

/// A moving vector at both ends of a range of t, in floating point.
struct EndVectors {
  PlanVector start;
  PlanVector end;
  /// At least the sum of the absolute values of the four numbers of the moving vector.
  double size;
};
EndVectors EndVectorsOf(const MovingVector& v, double from, double to);

/// Whether b is counter-clockwise of a, by less than half a turn, on the whole range of t. False
/// also where rounding leaves a doubt.
bool SurelyCounterClockwise(const EndVectors& a, const EndVectors& b);

/// Whether b is nowhere clockwise of a for t in [from, to]. False also where only an exact
/// comparison can tell.
bool SurelyInOrder(const BoundaryCurve& a, const BoundaryCurve& b, double from, double to);

/// Appends each t between `from` and `to` at which two curves cross, and perhaps some beyond.
void AppendCrossings(const BoundaryCurve& a, const BoundaryCurve& b, double from, double to,
                     std::vector<IsolatedRoot>& roots);

/// `from`, those of `roots` that lie strictly between, rising and each once, and `to`.
std::vector<IsolatedRoot> Cuts(const IsolatedRoot& from, std::vector<IsolatedRoot> roots,
                               const IsolatedRoot& to);

/// Builds the cells of a strip slab by slab, by rising t: a cell is extended where a slab begins at
/// its end and has the same two curves.
class StripBuilder {
 public:
  /// cells: receives the cells; must outlive the builder.
  explicit StripBuilder(std::vector<StripCell>& cells) : cells_(cells) {}

  /// between: the pairs of curves that bound the cells of the slab from `from` to `to`.
  /// Requires: `from` is the `to` of the slab before.
  void AddSlab(const IsolatedRoot& from, const IsolatedRoot& to, const CurvePairs& between);

 private:
  /// Numbers of cells.
  struct Slab {
    std::array<std::size_t, 2> cells{};
    std::size_t size = 0;
  };
  std::vector<StripCell>& cells_;
  Slab last_slab_;  // the cells that the last slab made or extended
};

}  // namespace farhorizon
