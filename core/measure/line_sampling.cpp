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

// The lines that a segment crosses, and its height over them.
struct Crossed {
  std::int64_t first = 0;
  std::int64_t last = -1;
  double height = 0;  // over line `first`
  double slope = 0;   // from line to line

  Crossed(const GridPoint& p, double place_p, const GridPoint& q, double place_q,
          double last_line) {
    const bool turned = place_p > place_q;
    const double from = turned ? place_q : place_p;
    const double to = turned ? place_p : place_q;
    if (!(to >= 0) || !(from <= last_line)) return;
    // The first line at or after `from`, the last at or before `to`. Conversion cuts off.
    const auto cut = static_cast<std::int64_t>(std::max(from, 0.0));
    first = static_cast<double>(cut) < from ? cut + 1 : cut;
    last = static_cast<std::int64_t>(std::min(to, last_line));
    if (last < first) return;
    const double at_from = turned ? q.height_m : p.height_m;
    const double at_to = turned ? p.height_m : q.height_m;
    slope = to > from ? (at_to - at_from) / (to - from) : 0;
    height = at_from + slope * (static_cast<double>(first) - from);
  }
};

// Puts into heights[begin ...], one a line of the pencil, the greatest height of the net's segments
// over it. places: of each point, where it is among the lines. The outline's segments come last, so
// that the others have no more to do than to keep the greatest height.
void GreatestHeights(const SkylineNet& net, const std::vector<double>& places, const Pencil& pencil,
                     std::size_t begin, SampledSkyline& skyline) {
  const double last_line = static_cast<double>(pencil.count) - 1;
  double* heights = skyline.heights.data() + begin;
  std::uint8_t* outline = skyline.outline.data() + begin;
  const auto crossed = [&](const SkylineNet::Segment& s) {
    return Crossed(net.Point(s.a), places[static_cast<std::size_t>(s.a)], net.Point(s.b),
                   places[static_cast<std::size_t>(s.b)], last_line);
  };
  for (const SkylineNet::Segment& s : net.segments) {
    if (s.outline) continue;
    const Crossed c = crossed(s);
    for (std::int64_t i = c.first; i <= c.last; ++i) {
      const double height = c.height + c.slope * static_cast<double>(i - c.first);
      heights[i] = heights[i] < height ? height : heights[i];
    }
  }
  for (const SkylineNet::Segment& s : net.segments) {
    if (!s.outline) continue;
    const Crossed c = crossed(s);
    for (std::int64_t i = c.first; i <= c.last; ++i) {
      const double height = c.height + c.slope * static_cast<double>(i - c.first);
      if (heights[i] >= height) continue;
      heights[i] = height;
      outline[i] = 1;
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
