// Each direction has a pencil of parallel lines at equal distances. A segment crosses a run of
// successive lines of a pencil, and its height over them changes by the same step from one to the
// next. So the greatest heights of a set over a pencil take one pass over its segments.
// Cost: for each direction and set, the lines that each segment crosses.
#include "core/measure/line_sampling.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace farhorizon {

namespace {

// The result is a sample, so any counts are sound: twice the directions or lines, twice the time.
constexpr int kDirections = 192;
constexpr double kLinesPerCell = 2;

constexpr double kMissed = -std::numeric_limits<double>::infinity();

// Parallel lines: the points with cosine * row - sine * column = first + i / kLinesPerCell.
struct Pencil {
  double sine;
  double cosine;
  double first;
  std::size_t count;

  // The i of the line through p, with a fraction between lines.
  [[nodiscard]] double IndexOf(const GridPoint& p) const {
    return (cosine * p.row - sine * p.column - first) * kLinesPerCell;
  }
};

Pencil PencilOf(int direction, std::int32_t columns, std::int32_t rows) {
  // The half keeps off the grid's own directions, in which a line would pass along a row of posts.
  const double theta = std::numbers::pi * (direction + 0.5) / kDirections;
  const double sine = std::sin(theta);
  const double cosine = std::cos(theta);
  const double width = columns - 1;
  const double height = rows - 1;
  const double least = -sine * width + std::min(0.0, cosine * height);
  const double greatest = std::max(0.0, cosine * height);
  const auto count = static_cast<std::size_t>((greatest - least) * kLinesPerCell) + 1;
  return {sine, cosine, least + 0.25 / kLinesPerCell, count};
}

// Per line of the pencil, the greatest height of the segments; kMissed where none crosses it.
void GreatestHeights(const std::vector<GridSegment>& segments, const Pencil& pencil,
                     std::vector<double>& heights) {
  heights.assign(pencil.count, kMissed);
  for (const GridSegment& segment : segments) {
    double from = pencil.IndexOf(segment.a);
    double to = pencil.IndexOf(segment.b);
    double at_from = segment.a.height_m;
    double at_to = segment.b.height_m;
    if (from > to) {
      std::swap(from, to);
      std::swap(at_from, at_to);
    }
    const double first = std::max(std::ceil(from), 0.0);
    const double last = std::min(std::floor(to), static_cast<double>(pencil.count) - 1);
    const double slope = to > from ? (at_to - at_from) / (to - from) : 0;
    if (last < first) continue;
    for (auto i = static_cast<std::size_t>(first); i <= static_cast<std::size_t>(last); ++i) {
      heights[i] = std::max(heights[i], at_from + slope * (static_cast<double>(i) - from));
    }
  }
}

}  // namespace

double RmsOverLines(const std::vector<GridSegment>& first, const std::vector<GridSegment>& second,
                    std::int32_t columns, std::int32_t rows) {
  std::vector<double> first_heights;
  std::vector<double> second_heights;
  double squares = 0;
  std::int64_t lines = 0;
  for (int direction = 0; direction < kDirections; ++direction) {
    const Pencil pencil = PencilOf(direction, columns, rows);
    GreatestHeights(first, pencil, first_heights);
    GreatestHeights(second, pencil, second_heights);
    for (std::size_t i = 0; i < pencil.count; ++i) {
      if (first_heights[i] == kMissed || second_heights[i] == kMissed) continue;
      const double difference = first_heights[i] - second_heights[i];
      squares += difference * difference;
      ++lines;
    }
  }
  return lines > 0 ? std::sqrt(squares / static_cast<double>(lines)) : 0;
}

}  // namespace farhorizon
