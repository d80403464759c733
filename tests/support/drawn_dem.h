#pragma once

#include <cmath>
#include <cstdint>
#include <random>
#include <sstream>
#include <string>
#include <vector>

#include "core/terrain/dem.h"

namespace farhorizon {

/// A DEM from a drawing: a line a row, whole numbers, "." for no data.
inline Dem DrawnDem(const std::string& drawing) {
  Dem dem;
  std::istringstream lines(drawing);
  for (std::string line; std::getline(lines, line);) {
    std::istringstream words(line);
    const std::size_t before = dem.heights.size();
    for (std::string word; words >> word;) {
      dem.heights.push_back(word == "." ? kNoHeight : std::stoi(word));
    }
    if (dem.heights.size() == before) continue;
    dem.columns = static_cast<std::int32_t>(dem.heights.size() - before);
    ++dem.rows;
  }
  return dem;
}

/// A DEM from a function of (column, row).
template <typename Height>
Dem DemOf(std::int32_t columns, std::int32_t rows, Height height) {
  Dem dem;
  dem.columns = columns;
  dem.rows = rows;
  dem.heights.reserve(static_cast<std::size_t>(columns) * static_cast<std::size_t>(rows));
  for (std::int32_t r = 0; r < rows; ++r) {
    for (std::int32_t c = 0; c < columns; ++c) dem.heights.push_back(height(c, r));
  }
  return dem;
}

/// Midpoint displacement on a square of side 2^power + 1: rough at every scale, as mountains are.
inline Dem FractalDem(int power, std::uint32_t seed, double height = 1000, double roughness = 0.5) {
  const std::int32_t n = (1 << power) + 1;
  std::mt19937 random(seed);
  const auto noise = [&random](double size) {
    return size * (static_cast<double>(random()) / 2147483648.0 - 1.0);
  };
  std::vector<double> z(static_cast<std::size_t>(n) * static_cast<std::size_t>(n), 0.0);
  const auto at = [&z, n](std::int32_t c, std::int32_t r) -> double& {
    return z[static_cast<std::size_t>(r * n + c)];
  };
  double size = height;
  for (std::int32_t step = n - 1; step > 1; step /= 2, size *= roughness) {
    const std::int32_t half = step / 2;
    for (std::int32_t r = half; r < n; r += step) {
      for (std::int32_t c = half; c < n; c += step) {
        at(c, r) = noise(size) + (at(c - half, r - half) + at(c + half, r - half) +
                                  at(c - half, r + half) + at(c + half, r + half)) /
                                     4;
      }
    }
    for (std::int32_t r = 0; r < n; r += half) {
      for (std::int32_t c = (r / half) % 2 == 0 ? half : 0; c < n; c += step) {
        double sum = 0;
        int count = 0;
        const auto add = [&](std::int32_t x, std::int32_t y) {
          if (x < 0 || y < 0 || x >= n || y >= n) return;
          sum += at(x, y);
          ++count;
        };
        add(c - half, r);
        add(c + half, r);
        add(c, r - half);
        add(c, r + half);
        at(c, r) = sum / count + noise(size);
      }
    }
  }
  return DemOf(n, n, [&at](std::int32_t c, std::int32_t r) {
    return static_cast<std::int32_t>(std::lround(at(c, r)));
  });
}

/// `dem` with the posts in discs punched out: lakes of no data, some across the border.
inline Dem WithHoles(Dem dem, int holes, std::uint32_t seed) {
  std::mt19937 random(seed);
  for (int i = 0; i < holes; ++i) {
    const auto c0 = static_cast<std::int32_t>(random() % static_cast<std::uint32_t>(dem.columns));
    const auto r0 = static_cast<std::int32_t>(random() % static_cast<std::uint32_t>(dem.rows));
    const auto radius = static_cast<std::int32_t>(1 + random() % 4);
    for (std::int32_t r = 0; r < dem.rows; ++r) {
      for (std::int32_t c = 0; c < dem.columns; ++c) {
        if ((c - c0) * (c - c0) + (r - r0) * (r - r0) < radius * radius) {
          dem.heights[static_cast<std::size_t>(r * dem.columns + c)] = kNoHeight;
        }
      }
    }
  }
  return dem;
}

}  // namespace farhorizon
