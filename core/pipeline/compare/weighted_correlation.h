#pragma once

#include <cmath>

namespace farhorizon {

/// The correlation of pairs of heights that come one after the other, each with a weight.
class WeightedCorrelation {
 public:
  void Add(double weight, double x, double y) {
    weight_ += weight;
    x_ += weight * x;
    y_ += weight * y;
    xx_ += weight * x * x;
    xy_ += weight * x * y;
    yy_ += weight * y * y;
  }

  /// 1 where both are level, 0 where one is or none has come. Level is what varies by less than a
  /// millimetre, or than sums of squares of such heights can tell.
  [[nodiscard]] double Value() const {
    if (weight_ == 0) return 0;
    const double var_x = xx_ / weight_ - x_ / weight_ * (x_ / weight_);
    const double var_y = yy_ / weight_ - y_ / weight_ * (y_ / weight_);
    const double level = 1e-6 + 1e-12 * (xx_ + yy_) / weight_;
    if (var_x <= level || var_y <= level) return var_x <= level && var_y <= level ? 1 : 0;
    return (xy_ / weight_ - x_ / weight_ * (y_ / weight_)) / std::sqrt(var_x * var_y);
  }

 private:
  double weight_ = 0;
  double x_ = 0;
  double y_ = 0;
  double xx_ = 0;
  double xy_ = 0;
  double yy_ = 0;
};

}  // namespace farhorizon
