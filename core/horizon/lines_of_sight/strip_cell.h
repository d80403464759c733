#pragma once

#include <optional>
#include <utility>
#include <vector>

#include "core/exact/isolated_root.h"
#include "core/horizon/visibility/moving_vector.h"

namespace farhorizon {

/// A direction of sight that moves with t along an edge, as its angle from the edge's own direction:
/// that direction itself (0), its opposite (half a turn), or a moving vector strictly between the two.
/// A direction of sight has no sense, so the half turn holds each once.
struct BoundaryCurve {
  enum class Kind { kAlong, kMoving, kAgainst };
  Kind kind = Kind::kMoving;
  MovingVector v;

  static BoundaryCurve Along() { return {Kind::kAlong, {}}; }
  static BoundaryCurve Against() { return {Kind::kAgainst, {}}; }
  friend bool operator==(const BoundaryCurve&, const BoundaryCurve&) = default;
};

/// Lines through an edge, as pairs of t and a direction: t in [from, to], directions from `first`
/// counter-clockwise to `last`. In the interior of the range of t, first < last.
///
/// Curves of moving vectors turn one way only: the direction of a + b t has a turn of the sign of
/// cross(a, b). So the directions of all t together are those from the least end of `first` to the
/// greatest end of `last`.
struct StripCell {
  IsolatedRoot from = IsolatedRoot::Zero();
  IsolatedRoot to = IsolatedRoot::One();
  BoundaryCurve first;
  BoundaryCurve last;
};

/// 1 where b is counter-clockwise of a around the point, -1 where clockwise, 0 where they are one direction
/// for all t. Exact. Requires: they do not cross at the point, which they may touch at.
int Order(const BoundaryCurve& a, const BoundaryCurve& b, const SamplePoint& point);

struct PlanVector {
  double x;
  double y;
};

/// A moving vector in plain numbers, at both ends of a range of t.
struct VectorRange {
  PlanVector start;
  PlanVector end;
  double size;  ///< of the numbers that it was made from
};
VectorRange VectorRangeOf(const MovingVector& v, double from, double to);

/// Whether b is counter-clockwise of a all the way, by more than rounding can be wrong.
bool SurelyTurns(const VectorRange& a, const VectorRange& b);

/// Whether b is nowhere clockwise of a; false where that takes a closer look.
bool SurelyInOrder(const BoundaryCurve& a, const BoundaryCurve& b, double from, double to);

/// Adds the t at which two curves cross between `from` and `to`, and perhaps others.
void AppendCrossings(const BoundaryCurve& a, const BoundaryCurve& b, double from, double to,
                     std::vector<IsolatedRoot>& roots);

/// `from`, those of `roots` that lie between, in order, and `to`.
std::vector<IsolatedRoot> Cuts(const IsolatedRoot& from, std::vector<IsolatedRoot> roots,
                               const IsolatedRoot& to);

/// Cells of a strip, made by rising t: those that go on where cells of the same curves ended grow,
/// others are new.
class StripBuilder {
 public:
  explicit StripBuilder(std::vector<StripCell>& cells) : cells_(cells) {}

  /// columns: first and last of each cell from `from` to `to`.
  void Add(const IsolatedRoot& from, const IsolatedRoot& to,
           const std::vector<std::pair<BoundaryCurve, BoundaryCurve>>& columns);

 private:
  std::vector<StripCell>& cells_;
  std::vector<std::size_t> open_;  // the numbers of the cells that ended last
};

}  // namespace farhorizon
