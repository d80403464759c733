#include "core/io/text_grid/text_grid.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

namespace farhorizon {

namespace {

// As GDAL does: values beyond float's are its greatest, except infinities.
float ToFloat(double value) {
  constexpr double kGreatest = std::numeric_limits<float>::max();
  return static_cast<float>(std::isfinite(value) ? std::clamp(value, -kGreatest, kGreatest)
                                                 : value);
}

}  // namespace

GridCells GridCells::OfFloats(const std::vector<float>& values) {
  GridCells cells;
  cells.is_float_ = true;
  cells.bits_.reserve(values.size());
  for (const float value : values) cells.bits_.push_back(std::bit_cast<std::uint32_t>(value));
  return cells;
}

void GridCells::BecomeFloats() {
  for (std::uint32_t& bits : bits_) {
    bits = std::bit_cast<std::uint32_t>(static_cast<float>(std::bit_cast<std::int32_t>(bits)));
  }
  is_float_ = true;
}

void GridCells::Add(double value, bool whole) {
  constexpr double kGreatest = std::numeric_limits<std::int32_t>::max();
  if (!is_float_ && !(whole && std::abs(value) <= kGreatest)) BecomeFloats();
  bits_.push_back(is_float_ ? std::bit_cast<std::uint32_t>(ToFloat(value))
                            : std::bit_cast<std::uint32_t>(static_cast<std::int32_t>(value)));
}

void GridCells::FlipRows(std::size_t columns) {
  const std::size_t rows = columns > 0 ? bits_.size() / columns : 0;
  for (std::size_t row = 0; row < rows / 2; ++row) {
    const auto north = bits_.begin() + static_cast<std::ptrdiff_t>(row * columns);
    const auto south = bits_.begin() + static_cast<std::ptrdiff_t>((rows - 1 - row) * columns);
    std::swap_ranges(north, north + static_cast<std::ptrdiff_t>(columns), south);
  }
}

}  // namespace farhorizon
