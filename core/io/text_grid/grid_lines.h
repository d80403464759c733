#pragma once

#include <cstdint>

#include "core/base/result.h"

namespace farhorizon {

/// How the cells of a text grid stand in lines, and whether that fits its header. A grid whose
/// header has a column too few is sheared, which nothing but its lines gives away.
class GridLines {
 public:
  explicit GridLines(std::int64_t columns) : columns_(columns) {}

  /// Takes a cell that stands in `line` of the file.
  void Take(std::int64_t line) {
    if (line != line_) EndLine(line);
    ++in_line_;
    ++cells_;
  }
  [[nodiscard]] std::int64_t cells() const { return cells_; }

  /// Whether the cells fill `rows` rows. Their number must be columns * rows. Where the file has as
  /// many lines as the grid has rows, each must hold one row; other files wrap their rows, and then
  /// lines of one length must not be the rows of a grid of another width.
  /// Errors: kUnsupportedData, kind "truncated" for too few cells in lines that fit, "not-a-raster"
  ///   where header and lines disagree.
  Status Judge(std::int64_t rows);

 private:
  void EndLine(std::int64_t next_line);
  [[nodiscard]] Status JudgeLines(std::int64_t rows) const;
  [[nodiscard]] Error Disagreement(std::int64_t rows) const;

  std::int64_t columns_;
  std::int64_t cells_ = 0;
  std::int64_t lines_ = 0;  ///< with cells, ended
  std::int64_t line_ = 0;   ///< of the last cell
  std::int64_t in_line_ = 0;
  std::int64_t first_length_ = 0;
  bool uniform_ = true;           ///< every line that has ended is as long as the first
  bool last_is_shorter_ = false;  ///< the only one that is not is the last
  std::int64_t odd_line_ = 0;     ///< the first that does not hold `columns_` cells
  std::int64_t odd_length_ = 0;
};

}  // namespace farhorizon
