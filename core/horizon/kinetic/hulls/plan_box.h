#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>

namespace farhorizon::kinetic {

/// An octagon around points of the plan: ranges of x, y, x + y and x - y. Floating point: the
/// points that are added are off by less than kMargin, and the octagon is that much wider.
class PlanBox {
 public:
  static constexpr double kMargin = 0x1p-10;

  /// Returns whether the octagon has grown.
  bool Add(double x, double y) {
    const std::array<double, 4> at{x, y, x + y, x - y};
    bool grown = false;
    for (std::size_t i = 0; i < at.size(); ++i) {
      const double margin = i < 2 ? kMargin : 2 * kMargin;
      if (at[i] - margin < low_[i]) {
        low_[i] = at[i] - margin;
        grown = true;
      }
      if (at[i] + margin > high_[i]) {
        high_[i] = at[i] + margin;
        grown = true;
      }
    }
    return grown;
  }
  void Add(const PlanBox& other) {
    for (std::size_t i = 0; i < low_.size(); ++i) {
      low_[i] = std::min(low_[i], other.low_[i]);
      high_[i] = std::max(high_[i], other.high_[i]);
    }
  }
  /// Makes it the whole plan.
  void AddAll() {
    low_.fill(-kFar);
    high_.fill(kFar);
  }

  [[nodiscard]] bool Intersects(const PlanBox& other) const {
    bool apart = false;
    for (std::size_t i = 0; i < low_.size(); ++i) {
      apart |= low_[i] > other.high_[i] || other.low_[i] > high_[i];
    }
    return !apart;
  }
  [[nodiscard]] bool Contains(double x, double y) const {
    return x >= low_[0] && x <= high_[0] && y >= low_[1] && y <= high_[1] && x + y >= low_[2] &&
           x + y <= high_[2] && x - y >= low_[3] && x - y <= high_[3];
  }
  /// How wide the octagon is, over how far it is from (x, y): about the angle that it takes there.
  [[nodiscard]] double WidthFrom(double x, double y) const {
    const double width = high_[0] - low_[0] + high_[1] - low_[1];
    const double away =
        std::abs(x - (low_[0] + high_[0]) / 2) + std::abs(y - (low_[1] + high_[1]) / 2);
    return width / (away + 1);
  }
  /// Whether the line through (x, y), off by kMargin at most, in direction (u, v) surely misses the
  /// octagon. Requires: |u| + |v| is about 1. Each pair of ranges is a rectangle; the line misses
  /// it if the centre is further from the line than a corner can be.
  [[nodiscard]] bool IsMissedBy(double x, double y, double u, double v) const {
    return Misses(0, {x, y}, {u, v}) || Misses(2, {x + y, x - y}, {u + v, u - v});
  }

 private:
  static constexpr double kFar = std::numeric_limits<double>::infinity();

  [[nodiscard]] bool Misses(std::size_t i, std::array<double, 2> through,
                            std::array<double, 2> along) const {
    const double across = along[0] * ((low_[i + 1] + high_[i + 1]) / 2 - through[1]) -
                          along[1] * ((low_[i] + high_[i]) / 2 - through[0]);
    const double reach = std::abs(along[0]) * (high_[i + 1] - low_[i + 1]) / 2 +
                         std::abs(along[1]) * (high_[i] - low_[i]) / 2;
    return std::abs(across) > reach + 8 * kMargin;
  }

  std::array<double, 4> low_{kFar, kFar, kFar, kFar};
  std::array<double, 4> high_{-kFar, -kFar, -kFar, -kFar};
};

}  // namespace farhorizon::kinetic
