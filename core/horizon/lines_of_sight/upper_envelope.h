#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/exact/fraction.h"
#include "core/horizon/visibility/occluder_set.h"

namespace farhorizon {

/// The direction in which a viewer far away looks: columns and rows.
/// Requires: |dc|, |dr| <= kMaxViewStep, not both 0.
struct ViewDirection {
  std::int32_t dc = 1;
  std::int32_t dr = 0;
};
inline constexpr std::int32_t kMaxViewStep = 1 << 22;

/// The offset of the line of sight through p, across the view: the same for all points of the line.
inline std::int64_t Offset(const Point3i& p, const ViewDirection& view) {
  return std::int64_t{view.dc} * p.y - std::int64_t{view.dr} * p.x;
}

/// How far away p is, rising in the direction of view.
inline std::int64_t Depth(const Point3i& p, const ViewDirection& view) {
  return std::int64_t{view.dc} * p.x + std::int64_t{view.dr} * p.y;
}

/// The piece of a segment that is on the envelope between two offsets, from < to.
struct EnvelopePiece {
  std::size_t segment = 0;
  Fraction from;
  Fraction to;
};

/// The upper envelope of `segments` as seen along `view`: at each offset the highest of them, of
/// several at one height the nearest to the viewer, of those the first.
///
/// By rising offsets; pieces of one segment that touch are joined. No piece has offsets at which
/// there is no segment, and none is of a segment parallel to the view, which is a point of it.
/// Exact. Limits: as OccluderSet. Cost: O(n log n) for segments that do not cross in space.
std::vector<EnvelopePiece> UpperEnvelope(std::span<const Segment> segments,
                                         const ViewDirection& view);

}  // namespace farhorizon
