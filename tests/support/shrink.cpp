#include "tests/support/shrink.h"

#include <algorithm>
#include <array>
#include <set>
#include <utility>

namespace farhorizon {
namespace {

Dem Without(const Dem& dem, std::int32_t column, std::int32_t row) {
  Dem smaller = dem;
  smaller.heights.clear();
  smaller.columns -= column >= 0 ? 1 : 0;
  smaller.rows -= row >= 0 ? 1 : 0;
  for (VertexId v = 0; v < dem.columns * dem.rows; ++v) {
    if (dem.Column(v) == column || dem.Row(v) == row) continue;
    smaller.heights.push_back(dem.heights[static_cast<std::size_t>(v)]);
  }
  return smaller;
}

/// Drops one row or column if it still fails then.
bool DropALine(Dem& dem, const std::function<bool(const Dem&)>& fails) {
  for (std::int32_t c = 0; c < dem.columns && dem.columns > 2; ++c) {
    Dem smaller = Without(dem, c, -1);
    if (fails(smaller)) return dem = std::move(smaller), true;
  }
  for (std::int32_t r = 0; r < dem.rows && dem.rows > 2; ++r) {
    Dem smaller = Without(dem, -1, r);
    if (fails(smaller)) return dem = std::move(smaller), true;
  }
  return false;
}

/// Heights by rank, 0 the lowest: the first thing to try on large numbers.
bool Rank(Dem& dem, const std::function<bool(const Dem&)>& fails) {
  const std::set<std::int32_t> levels(dem.heights.begin(), dem.heights.end());
  Dem ranked = dem;
  for (std::int32_t& h : ranked.heights) {
    if (h == kNoHeight) continue;
    h = static_cast<std::int32_t>(std::distance(levels.begin(), levels.find(h))) -
        (levels.contains(kNoHeight) ? 1 : 0);
  }
  if (ranked.heights == dem.heights || !fails(ranked)) return false;
  dem = std::move(ranked);
  return true;
}

/// Smaller values for a height, boldest first.
std::vector<std::int32_t> Lower(std::int32_t height) {
  if (height == 0) return {};
  return {0, height / 2, height > 0 ? height - 1 : height + 1};
}

/// Takes posts out and lowers heights; true if anything could be.
bool LowerPosts(Dem& dem, const std::function<bool(const Dem&)>& fails) {
  bool any = false;
  for (std::size_t i = 0; i < dem.heights.size(); ++i) {
    if (dem.heights[i] == kNoHeight) continue;
    std::vector<std::int32_t> values = Lower(dem.heights[i]);
    values.insert(values.begin(), kNoHeight);
    for (const std::int32_t value : values) {
      Dem lower = dem;
      lower.heights[i] = value;
      if (value == dem.heights[i] || !fails(lower)) continue;
      dem = std::move(lower);
      any = true;
      break;
    }
  }
  return any;
}

bool LowerEnds(std::vector<Segment>& segments,
               const std::function<bool(const std::vector<Segment>&)>& fails) {
  bool any = false;
  for (std::size_t i = 0; i < segments.size(); ++i) {
    for (Point3i Segment::*end : {&Segment::a, &Segment::b}) {
      for (const std::int32_t value : Lower((segments[i].*end).z)) {
        std::vector<Segment> lower = segments;
        (lower[i].*end).z = value;
        if (value == (segments[i].*end).z || !fails(lower)) continue;
        segments = std::move(lower);
        any = true;
        break;
      }
    }
  }
  return any;
}

}  // namespace

Dem Shrink(Dem dem, const std::function<bool(const Dem&)>& fails) {
  while (DropALine(dem, fails) || Rank(dem, fails) || LowerPosts(dem, fails)) {
  }
  return dem;
}

std::vector<Segment> Shrink(std::vector<Segment> segments,
                            const std::function<bool(const std::vector<Segment>&)>& fails) {
  bool any = true;
  while (any) {
    any = false;
    for (std::size_t i = 0; i < segments.size();) {
      std::vector<Segment> fewer = segments;
      fewer.erase(fewer.begin() + static_cast<std::ptrdiff_t>(i));
      if (fails(fewer)) {
        segments = std::move(fewer);
        any = true;
      } else {
        ++i;
      }
    }
    any = LowerEnds(segments, fails) || any;
  }
  return segments;
}

}  // namespace farhorizon
