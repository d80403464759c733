#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "core/horizon/kinetic/hulls/kinetic_hulls.h"

namespace farhorizon::kinetic {

using TangentId = std::int32_t;
/// One end of a tangent: 2 * tangent + 0 or 1. Its *own* hull is the one that it touches at this
/// end, its *other* hull the one at the opposite end. It is directed so that its own hull is on its
/// left.
using HalfTangentId = std::int32_t;
/// In place of a half tangent: an edge of the hull.
inline constexpr HalfTangentId kHullEdge = -1;

constexpr TangentId TangentOf(HalfTangentId half) { return half / 2; }
constexpr std::size_t EndOf(HalfTangentId half) { return half % 2 != 0 ? 1 : 0; }
constexpr HalfTangentId Opposite(HalfTangentId half) { return half ^ 1; }

/// The lines that touch a hull, from `start` to `end` counter-clockwise round it, are those that
/// meet one other hull on one of the two sides of the contact.
struct Arc {
  HalfTangentId start = -1;
  HalfTangentId end = -1;
};

/// The four bitangents of each two disjoint hulls [Archambault03, sections 3.2.1 to 3.2.3], as
/// geometry: which corners they touch, and in which order they pass a corner.
///
///       .--.--------------- 1 ---------------.--.
///      /    \ . 3                       2 . /    \      Directed from A to B:
///     (      )    '  .             .  '    (      )       0: both hulls on the left
///     (  A   )           '  . .  '         (  B   )       1: both on the right
///     (      )           .  ' '  .         (      )       2: A on the left, B on the right
///      \    / . 2  .  '             '  . 3  \    /        3: A on the right, B on the left
///       '--'--------------- 0 ---------------'--'       0 and 1 are outer, 2 and 3 inner tangents.
///
/// A is the hull with the lower slot. Counter-clockwise round A, B occludes the lines from 0 to 2
/// ahead of the contact, and from 3 to 1 behind it; so 0 and 3 start, 2 and 1 end.
///
/// Each hull has a slot, a row of a triangular table, so that the tangents of two hulls are found
/// without a search; a slot is used again once its hull was joined to another. A tangent supports
/// both hulls, except between the change of a corner and Walk(). While both inner tangents of two
/// hulls support them, the hulls are disjoint.
class TangentTable {
 public:
  /// Requires: `hulls` outlives it.
  explicit TangentTable(const KineticHulls& hulls) : hulls_(hulls) {}

  void AddCluster(ClusterId c);
  void RemoveCluster(ClusterId c);
  /// The first of the four tangents of two hulls: outer, outer, inner, inner.
  [[nodiscard]] TangentId First(ClusterId a, ClusterId b) const;
  /// Whether the four are made. Requires: `first` is a First().
  [[nodiscard]] bool Exists(TangentId first) const { return contacts_[Index(first)][0] >= 0; }
  /// Makes the four of two hulls. Cost: O(h), h corners.
  void Make(ClusterId a, ClusterId b);
  void Drop(TangentId first);

  [[nodiscard]] HalfTangentId half_count() const {
    return static_cast<HalfTangentId>(2 * contacts_.size());
  }
  /// The corners that a tangent touches; -1 where it is not made.
  [[nodiscard]] const std::array<PointId, 2>& contacts(TangentId t) const {
    return contacts_[Index(t)];
  }
  [[nodiscard]] PointId Own(HalfTangentId half) const {
    return contacts_[Index(TangentOf(half))][EndOf(half)];
  }
  [[nodiscard]] PointId Other(HalfTangentId half) const { return Own(Opposite(half)); }

  static bool Outer(TangentId t) { return t % 4 < 2; }
  /// Whether the other hull is ahead along the half tangent's direction, not behind.
  static bool Ahead(HalfTangentId half) {
    const int kind = TangentOf(half) % 4;
    return kind < 2 ? kind == half % 2 : kind == 2;
  }
  /// Whether the other hull begins to occlude lines there, counter-clockwise round the own hull.
  static bool Starts(HalfTangentId half) { return Outer(TangentOf(half)) == Ahead(half); }
  /// The arcs at the hull of end `end` of the four tangents from `first`: ahead, behind.
  static std::array<Arc, 2> ArcsAtEnd(TangentId first, std::int32_t end);
  /// What `other` occludes of the lines that touch c.
  [[nodiscard]] std::array<Arc, 2> ArcsAt(ClusterId c, ClusterId other) const;

  /// The step to take towards the corner at which the half tangent supports its own hull: to the
  /// next corner (1), to the previous one (-1), or none (0). From any corner of a convex polygon
  /// and any point outside it, such steps lead to the right one of the two tangents.
  [[nodiscard]] int StepAt(HalfTangentId half) const;
  /// Whether the tangent supports both hulls at corners.
  [[nodiscard]] bool Supports(TangentId t) const;
  /// Moves both ends to where the tangent supports the hulls [Archambault03, section 3.2.2].
  void Walk(TangentId t);
  void MoveTo(HalfTangentId half, PointId corner) {
    contacts_[Index(TangentOf(half))][EndOf(half)] = corner;
  }

  /// The order of two half tangents at one corner just after now, counter-clockwise. Those in line,
  /// for ever then, are ordered by one rule: starts before ends, then by id.
  [[nodiscard]] bool Before(HalfTangentId a, HalfTangentId b) const;
  /// Whether the directions between two half tangents or hull edges at corner p, in this order,
  /// have an interior just after now.
  [[nodiscard]] bool HasWidth(PointId p, HalfTangentId before, HalfTangentId after) const;

  /// Throws InternalError where tangents of the two do not support them.
  void CheckTangents(ClusterId a, ClusterId b) const;

 private:
  [[nodiscard]] std::int32_t SlotOf(ClusterId c) const { return slots_[Index(c)]; }

  const KineticHulls& hulls_;
  std::vector<std::int32_t> slots_;               // by cluster
  std::vector<ClusterId> clusters_;               // by slot; -1 where it is free
  std::vector<std::array<PointId, 2>> contacts_;  // by tangent; the first is of the lower slot
};

}  // namespace farhorizon::kinetic
