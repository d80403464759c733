#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <string>
#include <vector>

#include "core/base/assumption.h"

namespace farhorizon {

/// A post of the grid: `row * columns + column`.
using VertexId = std::int32_t;

/// The height of a post without data.
inline constexpr std::int32_t kNoHeight = std::numeric_limits<std::int32_t>::min();

/// Map coordinates of a post from its column and row, for a north-up (unrotated) grid:
/// x = origin_x + column * step_x, y = origin_y + row * step_y. Posts are the centres of cells.
struct GeoTransform {
  double origin_x = 0;
  double origin_y = 0;
  double step_x = 1;
  double step_y = -1;
};

/// A regular grid of exact heights.
///
/// heights: rows x columns, row-major, first row first as the file has it; in quanta, kNoHeight
/// where there is no data. A post's height is `height_offset_m + heights[id] * quantum_m` metres,
/// in the raster's vertical datum. Properties: 2 <= columns, rows <= 32768 and |heights| < 2^30.
/// The exact predicates require both (core/horizon/README.md, section 7).
struct Dem {
  std::int32_t columns = 0;
  std::int32_t rows = 0;
  std::vector<std::int32_t> heights;
  double quantum_m = 1;
  double height_offset_m = 0;
  bool quantized = false;  ///< heights were rounded to quantum_m: the report says so
  GeoTransform transform;
  std::string crs;          ///< as PROJ reads it: "EPSG:4326" or WKT
  Assumptions assumptions;  ///< that the reader has made

  [[nodiscard]] bool HasData(VertexId v) const {
    return heights[static_cast<std::size_t>(v)] != kNoHeight;
  }
  [[nodiscard]] double HeightM(VertexId v) const {
    return height_offset_m + heights[static_cast<std::size_t>(v)] * quantum_m;
  }
  [[nodiscard]] std::int32_t Column(VertexId v) const { return v % columns; }
  [[nodiscard]] std::int32_t Row(VertexId v) const { return v / columns; }
};

}  // namespace farhorizon
