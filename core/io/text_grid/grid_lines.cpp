// Judges the shape of a text grid by the lengths of its lines.
#include "core/io/text_grid/grid_lines.h"

#include <string>

namespace farhorizon {

void GridLines::EndLine(std::int64_t next_line) {
  if (in_line_ > 0) {
    ++lines_;
    if (lines_ == 1) first_length_ = in_line_;
    if (last_is_shorter_) uniform_ = false;
    last_is_shorter_ = uniform_ && in_line_ < first_length_;
    if (in_line_ > first_length_) uniform_ = false;
    if (in_line_ != columns_ && odd_line_ == 0) {
      odd_line_ = line_;
      odd_length_ = in_line_;
    }
  }
  line_ = next_line;
  in_line_ = 0;
}

Error GridLines::Disagreement(std::int64_t rows) const {
  std::string found = "the file has " + std::to_string(cells_) + " cells in " +
                      std::to_string(lines_) + (lines_ == 1 ? " line" : " lines");
  if (odd_line_ != 0) {
    found += ", and line " + std::to_string(odd_line_) + " has " + std::to_string(odd_length_);
  }
  return {ErrorCode::kUnsupportedData,
          "header and body of the grid disagree: ncols is " + std::to_string(columns_) +
              " and nrows " + std::to_string(rows) + ", which is " +
              std::to_string(columns_ * rows) + " cells, but " + found +
              "; write the true numbers of columns and rows into the header, or make the file "
              "again",
          "not-a-raster"};
}

Status GridLines::JudgeLines(std::int64_t rows) const {
  if (lines_ == rows) return odd_line_ == 0 ? Status(Ok{}) : Disagreement(rows);
  if (!uniform_ || last_is_shorter_) return Ok{};
  const std::int64_t length = first_length_;
  const bool exchanged = length == rows && lines_ == columns_;
  const bool wrapped = columns_ % length == 0 || length % columns_ == 0;
  return wrapped && !exchanged ? Status(Ok{}) : Disagreement(rows);
}

Status GridLines::Judge(std::int64_t rows) {
  EndLine(0);
  const std::int64_t wanted = columns_ * rows;
  if (cells_ == wanted) return JudgeLines(rows);
  const bool fits = odd_line_ == 0 || (uniform_ && last_is_shorter_ && first_length_ == columns_) ||
                    (lines_ != rows && first_length_ < columns_) || lines_ == 1;
  if (cells_ > wanted || !fits) return Disagreement(rows);
  return Error{ErrorCode::kUnsupportedData,
               "the raster is not complete: the grid has " + std::to_string(cells_) + " of its " +
                   std::to_string(wanted) + " cells (ncols " + std::to_string(columns_) +
                   " times nrows " + std::to_string(rows) + "); fetch or make the file again",
               "truncated"};
}

}  // namespace farhorizon
