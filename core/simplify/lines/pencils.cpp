#include "core/simplify/lines/pencils.h"

#include <numbers>

namespace farhorizon {

namespace {

// The first line of each pencil passes the tile's corner at this distance, cells: off the posts.
constexpr double kOffCorner = 0.37;

}  // namespace

Pencils::Pencils(std::int32_t columns, std::int32_t rows, std::int32_t directions) {
  const double width = columns - 1;
  const double height = rows - 1;
  std::int32_t first = 0;
  for (std::int32_t k = 0; k < directions; ++k) {
    const double theta = std::numbers::pi * (k + 0.5) / directions;
    const double x = -std::sin(theta);
    const double y = std::cos(theta);
    const double least = std::min(0.0, x * width) + std::min(0.0, y * height) + kOffCorner;
    const double most = std::max(0.0, x * width) + std::max(0.0, y * height);
    const std::int32_t count = std::max(0, static_cast<std::int32_t>(most - least + 1));
    pencils_.push_back(
        {static_cast<float>(x), static_cast<float>(y), static_cast<float>(least), count, first});
    for (std::int32_t i = 0; i < count; ++i) pencil_of_.push_back(static_cast<std::int16_t>(k));
    first += count;
  }
  asked_.assign(pencils_.size(), true);
  Activate();
}

void Pencils::Halve() {
  stride_ *= 2;
  const auto stride = static_cast<std::size_t>(stride_);
  for (std::size_t k = 0; k < pencils_.size(); ++k) asked_[k] = k % stride == stride - 1;
  Activate();
}

void Pencils::Activate() {
  active_.clear();
  x_.clear();
  y_.clear();
  shift_.clear();
  for (std::size_t k = 0; k < pencils_.size(); ++k) {
    if (!asked_[k]) continue;
    active_.push_back(pencils_[k]);
    x_.push_back(pencils_[k].x);
    y_.push_back(pencils_[k].y);
    shift_.push_back(pencils_[k].shift);
  }
}

}  // namespace farhorizon
