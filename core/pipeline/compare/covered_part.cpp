// A tile is held to the part of the DEM that it is of, and a mesh of the whole to the whole: posts
// that it leaves out beside covered ones are its error. Regions are followed by a list, not by
// calls, which could be as deep as a DEM has posts.
#include "core/pipeline/compare/covered_part.h"

#include <algorithm>
#include <cmath>

namespace farhorizon {

namespace {

bool HasCoveredNeighbour(const std::vector<double>& heights, const Dem& dem, VertexId v) {
  for (std::int32_t r = std::max(dem.Row(v) - 1, 0); r <= std::min(dem.Row(v) + 1, dem.rows - 1);
       ++r) {
    for (std::int32_t c = std::max(dem.Column(v) - 1, 0);
         c <= std::min(dem.Column(v) + 1, dem.columns - 1); ++c) {
      if (!std::isnan(heights[static_cast<std::size_t>(r * dem.columns + c)])) return true;
    }
  }
  return false;
}

}  // namespace

std::optional<CoveredPart> PartUnder(const std::vector<double>& heights, const Dem& dem) {
  bool whole = true;
  std::array<std::int32_t, 2> least = {dem.columns, dem.rows};
  std::array<std::int32_t, 2> most = {-1, -1};
  for (VertexId v = 0; v < dem.columns * dem.rows; ++v) {
    if (!dem.HasData(v)) continue;
    if (std::isnan(heights[static_cast<std::size_t>(v)])) {
      whole = whole && HasCoveredNeighbour(heights, dem, v);
      continue;
    }
    least = {std::min(least[0], dem.Column(v)), std::min(least[1], dem.Row(v))};
    most = {std::max(most[0], dem.Column(v)), std::max(most[1], dem.Row(v))};
  }
  if (whole) return std::nullopt;
  // A DEM has two columns and rows at least.
  for (std::size_t axis = 0; axis < 2; ++axis) {
    if (most[axis] > least[axis]) continue;
    (least[axis] > 0 ? least : most)[axis] += least[axis] > 0 ? -1 : 1;
  }
  CoveredPart part{dem, least};
  part.dem.columns = most[0] - least[0] + 1;
  part.dem.rows = most[1] - least[1] + 1;
  part.dem.transform.origin_x += least[0] * dem.transform.step_x;
  part.dem.transform.origin_y += least[1] * dem.transform.step_y;
  part.dem.heights.clear();
  for (std::int32_t r = least[1]; r <= most[1]; ++r) {
    for (std::int32_t c = least[0]; c <= most[0]; ++c) {
      const auto v = static_cast<std::size_t>(r * dem.columns + c);
      part.dem.heights.push_back(std::isnan(heights[v]) ? kNoHeight : dem.heights[v]);
    }
  }
  return part;
}

std::int64_t CountHolePosts(const std::vector<double>& heights, const Dem& dem) {
  std::vector<bool> seen(heights.size(), false);
  std::int64_t holes = 0;
  std::vector<VertexId> open;
  for (VertexId start = 0; start < dem.columns * dem.rows; ++start) {
    const auto bare = [&](VertexId v) {
      const auto i = static_cast<std::size_t>(v);
      return !seen[i] && std::isnan(heights[i]);
    };
    if (!bare(start)) continue;
    // One connected region of posts that are not covered.
    std::int64_t posts = 0;
    bool hole = true;
    open.push_back(start);
    seen[static_cast<std::size_t>(start)] = true;
    while (!open.empty()) {
      const VertexId v = open.back();
      open.pop_back();
      const std::int32_t c = dem.Column(v);
      const std::int32_t r = dem.Row(v);
      ++posts;
      const bool rim = c == 0 || r == 0 || c + 1 == dem.columns || r + 1 == dem.rows;
      hole = hole && !rim && dem.HasData(v);
      const std::array<VertexId, 4> around = {c > 0 ? v - 1 : v, c + 1 < dem.columns ? v + 1 : v,
                                              r > 0 ? v - dem.columns : v,
                                              r + 1 < dem.rows ? v + dem.columns : v};
      for (const VertexId next : around) {
        if (!bare(next)) continue;
        seen[static_cast<std::size_t>(next)] = true;
        open.push_back(next);
      }
    }
    if (hole) holes += posts;
  }
  return holes;
}

void MoveInto(const CoveredPart& part, GridMesh& mesh) {
  for (GridPoint& p : mesh.points) {
    p.column -= part.first[0];
    p.row -= part.first[1];
  }
}

}  // namespace farhorizon
