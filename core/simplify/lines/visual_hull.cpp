// Between two lines of a pencil the lower one's skyline counts, at a post the least of all pencils.
// A window has the least of its posts, so one look at it rules out all edges within; each is made
// of the one before, by rows and then by columns, at some comparisons a post whatever its radius.
#include "core/simplify/lines/visual_hull.h"

#include <limits>

#include "core/simplify/lines/sampled_skyline.h"

namespace farhorizon {

namespace {

constexpr float kAny = std::numeric_limits<float>::max();

}  // namespace

VisualHull::VisualHull(const Ground& ground, const Pencils& pencils, const Table<float>& skyline)
    : least_{ground.columns(), ground.rows(), {}} {
  least_.height.assign(least_.Index(0, least_.rows), kAny);
  std::vector<float> between;  // the lower H of lines i and i + 1
  for (const Pencils::Pencil& pencil : pencils.pencils()) {
    if (pencil.count == 0) continue;
    const auto height = [&](std::int32_t i) {
      const float z = i < pencil.count ? skyline[pencil.first + i] : SampledSkyline::kNone;
      return z > SampledSkyline::kNone ? z : kAny;
    };
    between.clear();
    for (std::int32_t i = 0; i < pencil.count; ++i) {
      between.push_back(std::min(height(i), height(i + 1)));
    }
    const auto most = static_cast<float>(pencil.count - 1);
    for (std::int32_t y = 0; y < least_.rows; ++y) {
      const float at_row = pencil.y * static_cast<float>(y) - pencil.shift;
      float* least = &least_.height[least_.Index(0, y)];
      for (std::int32_t x = 0; x < least_.columns; ++x) {
        // Below 0 casting rounds up to 0, as clamping does.
        const float place = std::clamp(pencil.x * static_cast<float>(x) + at_row, 0.0F, most);
        least[x] = std::min(least[x], between[static_cast<std::size_t>(place)]);
      }
    }
  }
  beside_ = Widened(least_, 1);
  wide_[0] = Widened(InBlocks(least_), 1);
  // The least of a window of radius 2 r is that of windows of radius r, r to each side.
  for (std::size_t k = 1; k < kWide; ++k) wide_[k] = Widened(wide_[k - 1], 1 << (k - 1));
}

VisualHull::Grid VisualHull::InBlocks(const Grid& from) {
  Grid to{(from.columns - 1) / kBlock + 1, (from.rows - 1) / kBlock + 1, {}};
  to.height.assign(to.Index(0, to.rows), kAny);
  for (std::int32_t y = 0; y < from.rows; ++y) {
    for (std::int32_t x = 0; x < from.columns; ++x) {
      float& least = to.height[to.Index(x / kBlock, y / kBlock)];
      least = std::min(least, from.height[from.Index(x, y)]);
    }
  }
  return to;
}

// The least of each height and those `reach` to all sides, which are windows themselves.
VisualHull::Grid VisualHull::Widened(const Grid& from, std::int32_t reach) {
  Grid rows = from;
  for (std::int32_t y = 0; y < from.rows; ++y) {
    const float* here = &from.height[from.Index(0, y)];
    float* least = &rows.height[from.Index(0, y)];
    for (std::int32_t x = 0; x < from.columns; ++x) {
      least[x] = std::min(
          {here[std::max(x - reach, 0)], here[x], here[std::min(x + reach, from.columns - 1)]});
    }
  }
  Grid to = rows;
  for (std::int32_t y = 0; y < from.rows; ++y) {
    const float* above = &rows.height[from.Index(0, std::max(y - reach, 0))];
    const float* here = &rows.height[from.Index(0, y)];
    const float* below = &rows.height[from.Index(0, std::min(y + reach, from.rows - 1))];
    float* least = &to.height[from.Index(0, y)];
    for (std::int32_t x = 0; x < from.columns; ++x) {
      least[x] = std::min({above[x], here[x], below[x]});
    }
  }
  return to;
}

bool VisualHull::MayRise(const Place& a, const Place& b) const {
  const std::int32_t dx = b.x - a.x;
  const std::int32_t dy = b.y - a.y;
  const std::int32_t n = 2 * std::max(std::abs(dx), std::abs(dy));
  const float part = 1.0F / static_cast<float>(n);
  const float step_x = static_cast<float>(dx) * part;
  const float step_y = static_cast<float>(dy) * part;
  const float step_z = (b.plan - a.plan) * part;
  for (std::int32_t i = 1; i < n; ++i) {
    const auto steps = static_cast<float>(i);
    const auto x = static_cast<std::int32_t>(static_cast<float>(a.x) + steps * step_x + 0.5F);
    const auto y = static_cast<std::int32_t>(static_cast<float>(a.y) + steps * step_y + 0.5F);
    if (a.plan + steps * step_z > least_.height[least_.Index(x, y)]) return true;
  }
  return false;
}

bool VisualHull::MayRiseAround(const Place& centre, const Place* places, std::int32_t count) const {
  float highest = centre.plan;
  std::int32_t reach = 1;
  for (const Place* p = places; p < places + count; ++p) {
    highest = std::max(highest, p->plan);
    reach = std::max({reach, std::abs(p->x - centre.x), std::abs(p->y - centre.y)});
  }
  if (reach == 1) return highest > beside_.height[beside_.Index(centre.x, centre.y)];
  std::size_t k = 0;
  while (k < kWide && (kBlock << k) < reach) ++k;
  if (k == kWide) return true;
  return highest > wide_[k].height[wide_[k].Index(centre.x / kBlock, centre.y / kBlock)];
}

}  // namespace farhorizon
