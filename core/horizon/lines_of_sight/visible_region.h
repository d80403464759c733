#pragma once

#include <array>
#include <optional>
#include <vector>

#include "core/horizon/lines_of_sight/strip_cell.h"
#include "core/horizon/lines_of_sight/strip_filter.h"
#include "core/horizon/visibility/face_wedge.h"
#include "core/horizon/visibility/segment_index.h"
#include "core/horizon/visibility/target_segment.h"

namespace farhorizon {

/// The lines of sight of one edge over a set of segments: exactly those pairs of t and direction in
/// whose line nothing of the set is higher than the edge, up to a set without interior points.
///
/// The region is all pairs of the wedge at first; each segment takes away what it hides. It stays a list of cells
/// that do not overlap, bounded by the curves of what hides beyond.
/// Requires: no segment of the set lies over the edge in plan, but at its ends.
/// Limits: as OccluderSet. Cost: some microseconds for each segment that shows beside nearer ones.
class VisibleRegion {
 public:
  /// wedge: what the ground beside the edge leaves free, if it is part of what hides (face_wedge.h).
  explicit VisibleRegion(const TargetSegment& edge,
                         const std::optional<FaceWedge>& wedge = std::nullopt);

  /// Takes away what all members of `index` but one hide.
  void Subtract(const SegmentIndex& index, std::int32_t except);

  /// Takes away what one segment hides.
  void Subtract(const SegmentIndex::Item& item);

  /// By no particular order.
  [[nodiscard]] const std::vector<StripCell>& cells() const { return cells_; }

 private:
  /// Whether ground up to `top` in the convex hull of the corners may hide anything that is left.
  template <std::size_t N>
  [[nodiscard]] bool MayMeet(const std::array<StripFilter::Corner, N>& corners, double top) const;
  void Subtract(const StripCell& hidden);
  /// What is left of `cell`; nullopt where that is all of it.
  [[nodiscard]] static std::optional<std::vector<StripCell>> Rest(const StripCell& cell,
                                                                  const StripCell& hidden);
  void Remove(std::size_t i);
  void Add(StripCell cell);

  TargetSegment edge_;
  StripFilter bounds_;
  std::vector<StripCell> cells_;
  std::vector<StripFilter::Cell> cell_bounds_;  // of cells_, in step
};

}  // namespace farhorizon
