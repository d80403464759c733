#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "core/horizon/kinetic/hulls/moving_point.h"
#include "core/horizon/kinetic/hulls/step_marks.h"
#include "core/horizon/kinetic/hulls/sweep_depth.h"

namespace farhorizon::kinetic {

/// The lines through a point, the *apex*, from a first direction counter-clockwise to a last one
/// that is at most half a turn on, and what hulls occlude of them just after `now`.
///
/// A hull that does not contain the apex lies between two of its corners as the apex sees it, its
/// *extent*; it occludes the lines that meet the segment between the two, ahead or behind:
///
///                  left ._____. right                 first     last
///                        \   /                          \       /
///          lines that     \ /                            \ . . /
///          are occluded    X  apex                        \   /
///                         / \                              \ /
///                        /   \                         -----X-----   hull of the apex, below
///
/// A *cover* is a chain of hulls that occludes all lines of the pencil: the first line meets the
/// extent of the first hull, the line at which a hull ends meets that of the next one, the last
/// line that of the last hull. While these lines meet these segments, all lines are occluded,
/// whatever becomes of the hulls: hulls only grow, so the segments stay inside them.
///
/// Hulls: KineticHulls, or FrozenHulls; has path(p), EndOf(p), corners(c) and now().
template <typename Hulls>
class LinePencil {
 public:
  /// The lines that touch the hull of corner `apex` there, from the edge that ends there to the one
  /// that begins there. Requires: all outlive it.
  LinePencil(const Hulls& hulls, const MovingPoint& apex, const MovingPoint& prev,
             const MovingPoint& next)
      : hulls_(hulls), apex_(apex), first_(prev), last_(&next) {}
  /// All lines through `apex`, from the direction in which it is seen from `behind` on.
  LinePencil(const Hulls& hulls, const MovingPoint& apex, const MovingPoint& behind)
      : hulls_(hulls), apex_(apex), first_(behind) {}

  /// A line of the pencil: through the point, or the first or the last one.
  struct Line {
    PointId through = kFirst;
    int sign = 1;  ///< of the direction that is counter-clockwise from the first, less than half a
                   ///< turn on: towards the point, or away from it
  };
  static constexpr PointId kFirst = -1;
  static constexpr PointId kLast = -2;

  struct Gap {
    Line from;
    Line to;
  };

  /// Requires: the hull has corners, and the apex is outside it or on its border.
  void Add(ClusterId c);
  [[nodiscard]] bool Has(ClusterId c) const;
  [[nodiscard]] std::size_t hull_count() const { return seen_.size(); }

  /// The first lines, counter-clockwise, that no hull added so far occludes; they have an interior.
  /// nullopt: the hulls cover the pencil. Cost: O(hulls) for each hull of the cover.
  std::optional<Gap> FindGap();
  /// A direction, in floating point, that some lines of the gap have nearly, to 2^-30: what misses
  /// it by more than that leaves a part of the gap free. nullopt where none is sure.
  [[nodiscard]] std::optional<Aim> DirectionIn(const Gap& gap) const;
  /// Whether the hull that was added last surely occludes the line of that direction.
  [[nodiscard]] bool LastOccludes(const Aim& direction) const;

  /// The hulls of the cover. Requires: FindGap() has found none.
  [[nodiscard]] const std::vector<ClusterId>& cover() const { return cover_hulls_; }
  /// The first depth before `end` at which a line of the cover may no longer meet its segment;
  /// nullopt: none. Requires: as for cover().
  [[nodiscard]] std::optional<SweepDepth> FailureBefore(std::int64_t end) const;

 private:
  struct Seen {
    ClusterId hull = -1;
    PointId right = -1;
    PointId left = -1;
    int right_side = 0;  // of the first line: 1 left of it, -1 right of it, 0 on it
    int left_side = 0;
  };
  // What a hull occludes, from a line to a line counter-clockwise; one that occludes the first line
  // has two such parts.
  struct Part {
    Line from;
    Line to;
    std::size_t seen = 0;
  };

  [[nodiscard]] const MovingPoint& PathOf(PointId p) const {
    return p == kFirst ? first_ : p == kLast ? *last_ : hulls_.path(p);
  }
  [[nodiscard]] int Orient(const MovingPoint& a, const MovingPoint& b) const {
    return OrientAfter(apex_, a, b, hulls_.now());
  }
  [[nodiscard]] int Order(const Line& a, const Line& b) const;
  [[nodiscard]] PointId ExtremeCorner(ClusterId c, int sense) const;
  [[nodiscard]] Aim AimOf(const Line& line) const;

  static constexpr Line kFirstLine{kFirst, 1};
  // Half a turn on where there is no last direction given.
  static constexpr Line kLastLine{kLast, 1};

  const Hulls& hulls_;
  const MovingPoint& apex_;
  const MovingPoint& first_;
  const MovingPoint* last_ = nullptr;
  std::vector<Seen> seen_;
  std::vector<Part> parts_;
  std::vector<std::size_t> cover_;  // of parts
  std::vector<ClusterId> cover_hulls_;
};

}  // namespace farhorizon::kinetic
