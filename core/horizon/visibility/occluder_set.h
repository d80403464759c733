#pragma once

#include <cstdint>
#include <memory>

#include "core/geometry/segment.h"
#include "core/horizon/visibility/visibility_query.h"

namespace farhorizon {

/// A set of segments that occlude what lies behind them: the skyline of a terrain, of a mesh or of
/// a network of ridges.
///
/// Queries depend on the set only through H(l), the greatest height of its segments over a plan
/// line l. The set may change; an id that Insert has returned is never used again. Every answer is
/// exact. Limits: |x|, |y| <= 2^16, |z| < 2^30.
/// Threads: any number may query at once while no thread inserts or erases.
class OccluderSet {
 public:
  /// columns, rows: the extent of the plan that segments will lie in.
  OccluderSet(std::int32_t columns, std::int32_t rows);
  ~OccluderSet();
  OccluderSet(OccluderSet&&) noexcept;
  OccluderSet& operator=(OccluderSet&&) noexcept;

  OccluderId Insert(const Segment& segment);
  void Erase(OccluderId id);
  [[nodiscard]] std::int64_t size() const;

  /// A line of sight that touches query.segment with no member above it, if an open set of such
  /// lines exists. With Ties::kBlock no line of that open set touches a member at the segment's
  /// height either; the witness itself may be at the border of the set and touch one.
  /// Cost: about the members that are visible from the segment.
  [[nodiscard]] Visibility FindLineOfSight(const VisibilityQuery& query) const;

 private:
  struct Index;
  std::unique_ptr<Index> index_;
};

}  // namespace farhorizon
