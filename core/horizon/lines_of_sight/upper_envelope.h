#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/exact/fraction.h"
#include "core/horizon/visibility/occluder_set.h"

namespace farhorizon {

/// The way that a viewer far away looks: columns and rows.
/// Requires: |dc|, |dr| <= kMaxViewStep, not both 0.
struct ViewDirection {
  std::int32_t dc = 1;
  std::int32_t dr = 0;
};
inline constexpr std::int32_t kMaxViewStep = 1 << 22;

/// How far across the view a point of the plan is: constant along lines of sight.
inline std::int64_t Across(const Point3i& p, const ViewDirection& view) {
  return std::int64_t{view.dc} * p.y - std::int64_t{view.dr} * p.x;
}

/// How far away it is, rising in the direction of view.
inline std::int64_t Depth(const Point3i& p, const ViewDirection& view) {
  return std::int64_t{view.dc} * p.x + std::int64_t{view.dr} * p.y;
}

/// What shows of a segment between two places across the view, from < to.
struct EnvelopePart {
  std::size_t segment = 0;
  Fraction from;
  Fraction to;
};

/// The upper envelope of `segments` as they are seen along `view`: at each place across the highest of
/// them, of several of one height the nearest to the viewer, of those the first.
///
/// By rising places; parts of one segment that touch are one. Nothing stands for places where there is no
/// segment, nor for segments along the view, which show as a point.
/// Exact. Limits: as OccluderSet. Cost: O(n log n) for segments that do not cross in space.
std::vector<EnvelopePart> UpperEnvelope(std::span<const Segment> segments,
                                        const ViewDirection& view);

}  // namespace farhorizon
