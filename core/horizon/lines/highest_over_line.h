#pragma once

#include <cstdint>
#include <optional>
#include <span>

#include "core/exact/fraction.h"
#include "core/geometry/segment.h"
#include "core/terrain/terrain.h"

namespace farhorizon {

/// A plan line through (x / 2, y / 2), in columns and rows, with an integer direction.
/// Requires: |x|, |y| < 2^20, |dc|, |dr| < 2^20, not both 0.
struct PlanLine {
  std::int32_t x = 0;
  std::int32_t y = 0;
  std::int32_t dc = 1;
  std::int32_t dr = 0;
};

/// A height in quanta.
using ExactHeight = Fraction;

/// g_e of core/horizon/README.md, section 1: the height of a segment where the line crosses it in
/// plan, the height of its higher end where the line contains it, nullopt where they do not meet.
/// Exact.
std::optional<ExactHeight> HeightOver(const Segment& segment, const PlanLine& line);

/// H(l): the greatest height of the segments over the line; nullopt where none meets it. Exact.
/// By definition, the slow twin of occluder_set.h and grid_line_query.h. Cost: O(segments).
std::optional<ExactHeight> HighestOver(std::span<const Segment> segments, const PlanLine& line);

/// The same for all edges of a terrain. Cost: O(edges).
std::optional<ExactHeight> HighestOver(const Terrain& terrain, const PlanLine& line);

}  // namespace farhorizon
