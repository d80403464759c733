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

// Puts into heights[begin ...], one a line of the pencil, the greatest height of the net's segments
// over it. places: of each point, where it is among the lines.
void GreatestHeights(const SkylineNet& net, const std::vector<double>& places, const Pencil& pencil,
                     std::size_t begin, SampledSkyline& skyline) {
  const double last_line = static_cast<double>(pencil.count) - 1;
  for (const SkylineNet::Segment& segment : net.segments) {
    const auto a = static_cast<std::size_t>(segment.a);
    const auto b = static_cast<std::size_t>(segment.b);
    double from = places[a];
    double to = places[b];
    double at_from = net.points[a].height_m;
    double at_to = net.points[b].height_m;
    if (from > to) {
      std::swap(from, to);
      std::swap(at_from, at_to);
    }
    if (!(to >= 0) || !(from <= last_line)) continue;
    // The first line at or after `from`, the last at or before `to`. Conversion cuts off.
    const auto cut = static_cast<std::int64_t>(std::max(from, 0.0));
    const std::int64_t first = static_cast<double>(cut) < from ? cut + 1 : cut;
    const auto last = static_cast<std::int64_t>(std::min(to, last_line));
    if (last < first) continue;
    const double slope = to > from ? (at_to - at_from) / (to - from) : 0;
    for (std::int64_t i = first; i <= last; ++i) {
      const double height = at_from + slope * (static_cast<double>(i) - from);
      const std::size_t at = begin + static_cast<std::size_t>(i);
      if (height <= skyline.heights[at]) continue;
      skyline.heights[at] = height;
      skyline.outline[at] = segment.outline ? 1 : 0;
    }
  }
}

}  // namespace

Result<SampledSkyline> SampleSkyline(const SkylineNet& net, std::int32_t columns, std::int32_t rows,
                                     const RunControl& control) {
  SampledSkyline skyline;
  std::vector<double> places(net.points.size());
  for (int direction = 0; direction < kDirections; ++direction) {
    if (control.StopRequested()) {
      return Error{ErrorCode::kCancelled, "stopped while sampling skylines"};
    }
    const Pencil pencil = PencilOf(direction, columns, rows);
    for (std::size_t i = 0; i < places.size(); ++i) places[i] = pencil.IndexOf(net.points[i]);
    const std::size_t begin = skyline.heights.size();
    skyline.heights.resize(begin + pencil.count, kMissed);
    skyline.outline.resize(begin + pencil.count, 0);
    GreatestHeights(net, places, pencil, begin, skyline);
  }
  return skyline;
}

SampledError Compare(const SampledSkyline& first, const SampledSkyline& second) {
  SampledError error;
  double squares = 0;
  std::int64_t lines = 0;
  for (std::size_t i = 0; i < first.heights.size(); ++i) {
    if (first.heights[i] == kMissed || second.heights[i] == kMissed) continue;
    const double difference = std::abs(first.heights[i] - second.heights[i]);
    double& greatest =
        first.outline[i] != 0 || second.outline[i] != 0 ? error.outline_max_m : error.max_m;
    greatest = std::max(greatest, difference);
    squares += difference * difference;
    ++lines;
  }
  error.rms_m = lines > 0 ? std::sqrt(squares / static_cast<double>(lines)) : 0;
  return error;
}

}  // namespace farhorizon
