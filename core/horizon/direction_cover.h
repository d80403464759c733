#pragma once

#include <optional>
#include <vector>

#include "core/horizon/direction.h"

namespace farhorizon {

/// A growing set of directions of sight: closed arcs, kept apart and in order. Exact.
template <typename Int>
class BasicDirectionCover {
 public:
  using Direction = BasicDirection<Int>;

  /// Adds the closed arc that turns counter-clockwise from `from` to `to` (less than half a turn;
  /// the two may be one direction). `crosses_start`: the arc passes the half turn's end and goes on
  /// at its beginning.
  void Add(const Direction& from, const Direction& to, bool crosses_start, PredicateCounts* counts);

  [[nodiscard]] bool IsComplete() const { return complete_; }

  /// True only if every direction whose key is within the range (which may cross the start: from >
  /// to) is in the set. For pruning: keys that are off
  /// by 1e-8 do no harm.
  [[nodiscard]] bool SurelyCovers(double from_key, double to_key) const;

  /// The widest open range of directions that is not in the set, as vectors a positive turn of at
  /// most half a turn apart; nullopt where the set is complete.
  struct Gap {
    BasicVector<Int> from;
    BasicVector<Int> to;
  };
  [[nodiscard]] std::optional<Gap> WidestGap() const;

 private:
  struct Interval {
    Direction from;
    Direction to;
    double from_bound;  ///< keys for pruning; past the half turn where it reaches an end of that
    double to_bound;
  };
  void AddInterval(const Direction& from, const Direction& to, PredicateCounts* counts);
  [[nodiscard]] bool SurelyCoversPart(double from_key, double to_key) const;

  std::vector<Interval> intervals_;
  bool complete_ = false;
};
using DirectionCover = BasicDirectionCover<Int128>;

}  // namespace farhorizon
