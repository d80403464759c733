#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "core/exact/predicate_counts.h"
#include "core/geometry/segment.h"
#include "core/horizon/visibility/face_wedge.h"
#include "core/horizon/witness.h"

namespace farhorizon {

/// What level ground does to the sight along it.
enum class Ties {
  kPass,   ///< a line of sight may run on at the height of level ground (definition D2)
  kBlock,  ///< ground of equal height hides (whether a segment would raise the skyline)
};

/// What is known beforehand of a segment that is to be sighted. It saves time, and never changes whether
/// there is a line of sight, though another one may be found.
struct OcclusionHints {
  /// Segments known not to rise above the set's H, each with its lower end first.
  std::span<const Segment> virtual_occluders;
  /// Members to try first, say what hid a neighbour.
  std::span<const std::int32_t> likely;
  /// Directions that the ground beside the segment leaves free; it must not rise above the set's H.
  std::optional<FaceWedge> wedge;
};

/// How much a question may cost, in decisions as PredicateCounts counts them. It is looked at between
/// points of the segment, so that a last one may go beyond.
struct DecisionLimit {
  std::int64_t decisions = 0;
  bool reached = false;  ///< set where it ended the search: no sight then means none is known
};

/// A set of segments that hide what lies behind them: the skyline of a terrain, a mesh, a network.
///
/// H(l), the greatest height of the segments over a plan line l, is all that is ever asked of it.
/// The set may change; ids are handed out by Insert and are never used again. Properties: every
/// answer is exact. Limits: |x|, |y| <= 2^16, |z| < 2^30. Threads: any number may ask at once while
/// nobody inserts or erases.
class OccluderSet {
 public:
  /// columns, rows: the extent of the plan that segments will lie in.
  OccluderSet(std::int32_t columns, std::int32_t rows);
  ~OccluderSet();
  OccluderSet(OccluderSet&&) noexcept;
  OccluderSet& operator=(OccluderSet&&) noexcept;

  using Id = std::int32_t;
  Id Insert(const Segment& segment);
  void Erase(Id id);
  [[nodiscard]] std::int64_t size() const;

  /// A line of sight that touches `segment` and meets nothing of the set above it, among lines of a
  /// set with non-empty interior that meet nothing at its height either where ties block; nullopt if
  /// there is no such set. (The line itself may touch ground of equal height.)
  ///
  /// except: one member to look through, usually the segment itself. blockers: where not null and the
  /// answer is nullopt, receives ids that hide all of it, unsorted, but for what hints hide.
  /// limit: where not null, when to give up; needs counts.
  /// Cost: about the segments in sight.
  [[nodiscard]] std::optional<Witness> FindLineOfSight(const Segment& segment, Ties ties,
                                                       std::optional<Id> except = std::nullopt,
                                                       const OcclusionHints& hints = {},
                                                       std::vector<Id>* blockers = nullptr,
                                                       PredicateCounts* counts = nullptr,
                                                       DecisionLimit* limit = nullptr) const;

 private:
  struct Index;
  std::unique_ptr<Index> index_;
};

}  // namespace farhorizon
