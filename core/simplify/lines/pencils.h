#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <vector>

#include "core/simplify/mesh/place.h"
#include "core/simplify/mesh/table.h"

namespace farhorizon {

/// Plan lines, drawn evenly over directions and offsets: pencils of parallel lines, one cell apart,
/// directions pi (k + 1/2) / count. A line's number counts through all pencils.
class Pencils {
 public:
  Pencils(std::int32_t columns, std::int32_t rows, std::int32_t directions);

  /// Lines x column + y row - shift = i, for i from 0 to count - 1; the first has number `first`.
  struct Pencil {
    float x;
    float y;
    float shift;
    std::int32_t count;
    std::int32_t first;
  };
  [[nodiscard]] const std::vector<Pencil>& pencils() const { return pencils_; }
  [[nodiscard]] std::int32_t lines() const { return pencil_of_.size(); }
  [[nodiscard]] bool IsAsked(std::int32_t line) const {
    return asked_[static_cast<std::size_t>(pencil_of_[line])];
  }
  /// Leaves out every other of the pencils that are still asked, for good.
  void Halve();

  /// visit(line, height) for every asked line that the segment ab crosses.
  template <typename Visit>
  void ForEachLineAcross(const Place& a, const Place& b, Visit visit) const;

  /// On which side of the line each of `count` places is, and how far.
  void Distances(std::int32_t line, const Place* places, std::int32_t count,
                 float* distances) const {
    const Pencil& pencil = pencils_[static_cast<std::size_t>(pencil_of_[line])];
    const float shift = pencil.shift + static_cast<float>(line - pencil.first);
    for (std::int32_t i = 0; i < count; ++i) {
      distances[i] = pencil.x * static_cast<float>(places[i].x) +
                     pencil.y * static_cast<float>(places[i].y) - shift;
    }
  }
  [[nodiscard]] float Distance(std::int32_t line, const Place& place) const {
    float distance = 0;
    Distances(line, &place, 1, &distance);
    return distance;
  }

 private:
  void Activate();

  std::vector<Pencil> pencils_;
  std::vector<bool> asked_;  // per pencil
  std::int32_t stride_ = 1;  // between pencils that are asked
  Table<std::int16_t> pencil_of_;
  std::vector<Pencil> active_;  // the asked ones, and their members apart, for vector instructions
  std::vector<float> x_;
  std::vector<float> y_;
  std::vector<float> shift_;
};

/// Whether places at distances s and t from a line lie on either side of it.
inline bool Crosses(float s, float t) { return (s < 0) != (t < 0); }
/// The height over a line of the segment between places at distances s and t from it.
inline float HeightBetween(const Place& a, const Place& b, float s, float t) {
  return a.plan + (b.plan - a.plan) * (s / (s - t));
}

template <typename Visit>
void Pencils::ForEachLineAcross(const Place& a, const Place& b, Visit visit) const {
  constexpr std::size_t kBlock = 64;
  std::array<float, kBlock> from;
  std::array<float, kBlock> to;
  const auto ax = static_cast<float>(a.x);
  const auto ay = static_cast<float>(a.y);
  const auto bx = static_cast<float>(b.x);
  const auto by = static_cast<float>(b.y);
  for (std::size_t base = 0; base < active_.size(); base += kBlock) {
    const std::size_t n = std::min(kBlock, active_.size() - base);
    for (std::size_t k = 0; k < n; ++k) {
      from[k] = x_[base + k] * ax + y_[base + k] * ay - shift_[base + k];
      to[k] = x_[base + k] * bx + y_[base + k] * by - shift_[base + k];
    }
    for (std::size_t k = 0; k < n; ++k) {
      const float low = std::min(from[k], to[k]);
      const float high = std::max(from[k], to[k]);
      auto i = static_cast<std::int32_t>(low);
      if (static_cast<float>(i) < low) ++i;
      if (static_cast<float>(i) > high) continue;
      const Pencil& pencil = active_[base + k];
      const std::int32_t last = std::min(pencil.count - 1, static_cast<std::int32_t>(high));
      const float slope = high > low ? (b.plan - a.plan) / (to[k] - from[k]) : 0;
      for (i = std::max(i, 0); i <= last; ++i) {
        visit(pencil.first + i, a.plan + slope * (static_cast<float>(i) - from[k]));
      }
    }
  }
}

}  // namespace farhorizon
