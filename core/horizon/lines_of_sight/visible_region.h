#pragma once

#include <array>
#include <optional>
#include <vector>

#include "core/horizon/lines_of_sight/strip_cell.h"
#include "core/horizon/lines_of_sight/strip_filter.h"
#include "core/horizon/visibility/face_wedge.h"
#include "core/horizon/visibility/segment_index.h"
#include "core/horizon/visibility/target_segment.h"
#include "core/horizon/work_budget.h"

namespace farhorizon {

/// The lines of sight of one edge over a set of occluders: the pairs of t and direction on whose
/// line no occluder rises above the edge. Exact, up to a set of lines without interior points.
///
/// The region begins as all pairs that the wedge leaves free, and each occluder that is added takes
/// away what it occludes. It is a list of cells that do not overlap.
/// Requires: in plan no occluder lies over the edge, except at its ends.
/// Limits: as OccluderSet. Cost: some microseconds for each occluder that is visible beside nearer
/// ones.
class VisibleRegion {
 public:
  /// wedge: the directions that the faces beside the edge leave free, if the edge is one of a
  /// terrain (core/horizon/README.md, theorem 7).
  explicit VisibleRegion(const TargetSegment& edge,
                         const std::optional<FaceWedge>& wedge = std::nullopt);

  /// The most decisions (work_budget.h) that adding occluders may take; unset: any number. Past it
  /// none is added any more, and the region says nothing.
  void LimitWork(std::int64_t decisions) { work_limit_ = decisions; }
  /// Decisions so far. Requires for a region that says something: less than the limit.
  [[nodiscard]] std::int64_t work() const { return work_; }

  /// Adds all members of `index` except one, the nearest first: then others are skipped sooner.
  void AddOccluders(const SegmentIndex& index, std::int32_t except);
  void AddOccluder(const SegmentIndex::Item& item);

  /// In no particular order.
  [[nodiscard]] const std::vector<StripCell>& cells() const { return cells_; }

 private:
  // False only if nothing in the convex hull of the corners, up to the height `top`, occludes any
  // part of the region.
  template <std::size_t N>
  [[nodiscard]] bool MayOcclude(const std::array<StripFilter::Corner, N>& corners,
                                double top) const;
  void Subtract(const StripCell& occluded);
  // `cell` without `occluded`; nullopt where that is all of `cell`.
  [[nodiscard]] static std::optional<std::vector<StripCell>> Difference(const StripCell& cell,
                                                                        const StripCell& occluded);
  void Remove(std::size_t i);
  void Insert(StripCell cell);

  TargetSegment edge_;
  StripFilter filter_;
  std::vector<StripCell> cells_;
  std::vector<StripFilter::CellBounds> bounds_;  // of cells_, in step
  std::int64_t work_limit_ = WorkBudget::kMost;
  std::int64_t work_ = 0;
};

}  // namespace farhorizon
