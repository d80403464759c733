#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <optional>
#include <vector>

namespace farhorizon {

/// The cells of a grid that was read from text, in four bytes each: integers while all are, floats
/// from the first that is not. GDAL decides so, too, for the text grids that it reads.
class GridCells {
 public:
  /// Cells with these values.
  static GridCells OfFloats(const std::vector<float>& values);

  void Reserve(std::size_t cells) { bits_.reserve(cells); }
  /// Adds a value; whole: written without point or exponent.
  void Add(double value, bool whole);
  /// Reverses the order of rows of `columns` cells.
  void FlipRows(std::size_t columns);

  [[nodiscard]] bool is_float() const { return is_float_; }
  [[nodiscard]] std::size_t size() const { return bits_.size(); }
  /// The std::int32_t or float values.
  [[nodiscard]] const void* data() const { return bits_.data(); }

 private:
  void BecomeFloats();

  std::vector<std::uint32_t> bits_;
  bool is_float_ = false;
};

/// A grid that was read from text: rows from north to south.
struct TextGrid {
  std::int64_t columns = 0;
  std::int64_t rows = 0;
  GridCells cells = {};                     ///< columns x rows
  std::array<double, 6> geotransform = {};  ///< as GDAL has it, of cell corners
  std::optional<double> nodata = {};        ///< as the file states it
};

/// How large a grid may be.
struct GridLimits {
  std::int64_t max_cells = 0;  ///< one with more is refused
  /// Of one with more, the cells stay unread: TextGrid::cells is empty.
  std::int64_t most_read = std::numeric_limits<std::int64_t>::max();
};

}  // namespace farhorizon
