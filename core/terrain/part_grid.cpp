#include "core/terrain/part_grid.h"

#include <cmath>

#include "core/base/result.h"

namespace farhorizon {

namespace {

constexpr double kFewestOfPiece = 32;

}  // namespace

int SidePartDepth(std::int64_t posts, double share) {
  const double pieces = share * static_cast<double>(posts) / kFewestOfPiece;
  int depth = 0;
  while (depth < kMostPartDepth && std::ldexp(1.0, depth + 1) <= pieces) ++depth;
  return depth;
}

PartDepth PartDepthFor(std::int64_t triangles, std::int64_t part_triangles, const PartDepth& most) {
  PartDepth depth;
  if (part_triangles == 0) return depth;
  while (triangles > part_triangles * depth.Parts() && depth != most) {
    if (depth.columns < most.columns) ++depth.columns;
    if (depth.rows < most.rows) ++depth.rows;
  }
  return depth;
}

bool PartGrid::IsCutAt(std::int64_t i, std::int64_t posts, int depth) {
  const std::int64_t pieces = std::int64_t{1} << depth;
  // The cut after piece j is at the whole part of j (posts - 1) / pieces.
  const std::int64_t j = (i * pieces + posts - 2) / (posts - 1);
  return j > 0 && j < pieces && j * (posts - 1) / pieces == i;
}

PartGrid::Cuts::Cuts(std::int32_t posts, int depth) {
  if (depth == 0) return;
  std::int8_t cuts = 0;
  up_to_.reserve(static_cast<std::size_t>(posts));
  for (std::int32_t p = 0; p < posts; ++p) {
    if (IsCutAt(p, posts, depth)) ++cuts;
    up_to_.push_back(cuts);
  }
}

PartGrid::PartGrid(std::int32_t columns, std::int32_t rows, const PartDepth& depth)
    : depth_(depth), columns_(columns, depth.columns), rows_(rows, depth.rows) {
  Check(depth.columns <= kMostPartDepth && depth.rows <= kMostPartDepth, "a level of many parts");
}

}  // namespace farhorizon
