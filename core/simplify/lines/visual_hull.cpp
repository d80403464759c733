#include "core/simplify/lines/visual_hull.h"

#include <limits>

#include "core/simplify/lines/sampled_skyline.h"

namespace farhorizon {

namespace {

constexpr float kAny = std::numeric_limits<float>::max();

}  // namespace

VisualHull::VisualHull(const Ground& ground, const Pencils& pencils, const Table<float>& skyline)
    : columns_(ground.columns()), rows_(ground.rows()) {
  const std::size_t posts = Index(0, rows_);
  least_[0].assign(posts, kAny);
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
    for (std::int32_t y = 0; y < rows_; ++y) {
      const float at_row = pencil.y * static_cast<float>(y) - pencil.shift;
      float* least = &least_[0][Index(0, y)];
      for (std::int32_t x = 0; x < columns_; ++x) {
        // Below 0 casting rounds up to 0, as clamping does.
        const float place = std::clamp(pencil.x * static_cast<float>(x) + at_row, 0.0F, most);
        least[x] = std::min(least[x], between[static_cast<std::size_t>(place)]);
      }
    }
  }
  for (std::size_t window = 1; window < kWindows; ++window) Widen(window);
}

// The least of a window of radius r is that of windows of half of it, r / 2 to each side.
void VisualHull::Widen(std::size_t window) {
  const std::int32_t reach = window == 1 ? 1 : 1 << (window - 2);
  const std::vector<float>& from = least_[window - 1];
  std::vector<float> rows(from.size());
  for (std::int32_t y = 0; y < rows_; ++y) {
    for (std::int32_t x = 0; x < columns_; ++x) {
      rows[Index(x, y)] = std::min({from[Index(std::max(x - reach, 0), y)], from[Index(x, y)],
                                    from[Index(std::min(x + reach, columns_ - 1), y)]});
    }
  }
  std::vector<float>& to = least_[window];
  to.resize(from.size());
  for (std::int32_t y = 0; y < rows_; ++y) {
    const float* above = &rows[Index(0, std::max(y - reach, 0))];
    const float* here = &rows[Index(0, y)];
    const float* below = &rows[Index(0, std::min(y + reach, rows_ - 1))];
    float* least = &to[Index(0, y)];
    for (std::int32_t x = 0; x < columns_; ++x) {
      least[x] = std::min({above[x], here[x], below[x]});
    }
  }
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
    if (a.plan + steps * step_z > least_[0][Index(x, y)]) return true;
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
  std::size_t window = 1;
  while (window < kWindows && (1 << (window - 1)) < reach) ++window;
  return window == kWindows || highest > least_[window][Index(centre.x, centre.y)];
}

}  // namespace farhorizon
