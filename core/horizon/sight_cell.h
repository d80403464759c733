#pragma once

#include <optional>
#include <utility>
#include <vector>

#include "core/exact/placed_root.h"
#include "core/horizon/sight_sample.h"

namespace farhorizon {

/// A direction of sight that moves with t along an edge, as its angle from the edge's own direction:
/// that direction itself (0), its opposite (half a turn), or a moving vector strictly between the two.
/// A direction of sight has no sense, so the half turn holds each once.
struct SightCurve {
  enum class Kind { kAlong, kMoving, kAgainst };
  Kind kind = Kind::kMoving;
  MovingVector v;

  static SightCurve Along() { return {Kind::kAlong, {}}; }
  static SightCurve Against() { return {Kind::kAgainst, {}}; }
  friend bool operator==(const SightCurve&, const SightCurve&) = default;
};

/// Lines through an edge, as pairs of t and a direction: t in [from, to], directions from `first`
/// counter-clockwise to `last`. In the interior of the range of t, first < last.
///
/// Curves of moving vectors turn one way only: the direction of a + b t has a turn of the sign of
/// cross(a, b). So the directions of all t together are those from the least end of `first` to the
/// greatest end of `last`.
struct SightCell {
  PlacedRoot from = PlacedRoot::Zero();
  PlacedRoot to = PlacedRoot::One();
  SightCurve first;
  SightCurve last;
};

/// 1 where b is counter-clockwise of a around the point, -1 where clockwise, 0 where they are one direction
/// for all t. Exact. Requires: they do not cross at the point, which they may touch at.
int Order(const SightCurve& a, const SightCurve& b, const TestPoint& point);

struct PlanVector {
  double x;
  double y;
};

/// A moving vector in plain numbers, at both ends of a range of t.
struct Sweep {
  PlanVector start;
  PlanVector end;
  double size;  ///< of the numbers that it was made from
};
Sweep SweepOf(const MovingVector& v, double from, double to);

/// Whether b is counter-clockwise of a all the way, by more than rounding can be wrong.
bool SurelyTurns(const Sweep& a, const Sweep& b);

/// Whether b is nowhere clockwise of a; false where that takes a closer look.
bool SurelyInOrder(const SightCurve& a, const SightCurve& b, double from, double to);

/// Adds the t at which two curves cross between `from` and `to`, and perhaps others.
void AppendCrossings(const SightCurve& a, const SightCurve& b, double from, double to,
                     std::vector<PlacedRoot>& roots);

/// `from`, those of `roots` that lie between, in order, and `to`.
std::vector<PlacedRoot> Cuts(const PlacedRoot& from, std::vector<PlacedRoot> roots,
                             const PlacedRoot& to);

/// Cells of a strip, made by rising t: those that go on where cells of the same curves ended grow,
/// others are new.
class CellStrip {
 public:
  explicit CellStrip(std::vector<SightCell>& cells) : cells_(cells) {}

  /// columns: first and last of each cell from `from` to `to`.
  void Add(const PlacedRoot& from, const PlacedRoot& to,
           const std::vector<std::pair<SightCurve, SightCurve>>& columns);

 private:
  std::vector<SightCell>& cells_;
  std::vector<std::size_t> open_;  // the numbers of the cells that ended last
};

}  // namespace farhorizon
