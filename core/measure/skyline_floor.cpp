// For each range of directions the segments are added in falling order of their lower ends, and
// connected ones are kept together with the strips that they span. What a component spans for the
// first time gets the present height.
#include "core/measure/skyline_floor.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <numeric>
#include <tuple>

#include "core/geometry/union_find.h"

namespace farhorizon {

namespace {

constexpr float kUnknown = -std::numeric_limits<float>::infinity();

// Cells that lines of one offset and one range of directions are apart, at most, at the corners of
// the plan. Any value is sound: less takes longer here and leaves less to the search by boxes.
constexpr double kSpread = 6;
constexpr int kLeastDirections = 16;

// What a component spans: every line of the range whose offset is in [from, to] meets it.
struct Span {
  float from;
  float to;
};

float RoundedDown(double value) {
  const auto rounded = static_cast<float>(value);
  return rounded > value ? std::nextafter(rounded, kUnknown) : rounded;
}

class FloorFinder {
 public:
  FloorFinder(const SkylineNet& net, const std::vector<double>& lowered_m, SkylineFloor& floor)
      : net_(net),
        floor_(floor),
        parent_(net.points.size()),
        spans_(net.points.size()),
        next_free_(static_cast<std::size_t>(floor.strips.count) + 1) {
    for (std::size_t i = 0; i < net.segments.size(); ++i) {
      if (!std::isfinite(lowered_m[i])) continue;
      const SkylineNet::Segment& s = net.segments[i];
      const double lower_end = std::min(net.Point(s.a).height_m, net.Point(s.b).height_m);
      order_.push_back({RoundedDown(lower_end - lowered_m[i]), s.a, s.b});
    }
    std::sort(order_.begin(), order_.end(), [](const Lowered& p, const Lowered& q) {
      return std::tie(q.height, p.a, p.b) < std::tie(p.height, q.a, q.b);
    });
  }

  void FindRange(int k) {
    const LineStrips& strips = floor_.strips;
    const DirectionRange range = strips.Range(k);
    for (std::size_t i = 0; i < net_.points.size(); ++i) {
      const double at_first = strips.OffsetOf(net_.points[i], range.first);
      const double at_last = strips.OffsetOf(net_.points[i], range.last);
      spans_[i] = {static_cast<float>(std::max(at_first, at_last) + strips.slack),
                   static_cast<float>(std::min(at_first, at_last) - strips.slack)};
    }
    std::iota(parent_.begin(), parent_.end(), 0);
    std::iota(next_free_.begin(), next_free_.end(), 0);
    float* heights =
        &floor_.heights[static_cast<std::size_t>(k) * static_cast<std::size_t>(strips.count)];
    for (const Lowered& s : order_) {
      const std::int32_t a = FindRoot(parent_, s.a);
      const std::int32_t b = FindRoot(parent_, s.b);
      if (a == b) continue;
      parent_[static_cast<std::size_t>(b)] = a;
      Span& span = spans_[static_cast<std::size_t>(a)];
      const Span& joined = spans_[static_cast<std::size_t>(b)];
      if (joined.from >= span.from && joined.to <= span.to) continue;
      span = {std::min(span.from, joined.from), std::max(span.to, joined.to)};
      if (span.from < span.to) Fill(span, s.height, heights);
    }
  }

 private:
  struct Lowered {
    float height;  // of its lower end
    std::int32_t a;
    std::int32_t b;
  };

  // Gives the strips that lie in the span, and have no height yet, this one.
  void Fill(const Span& span, float height, float* heights) {
    const double middle = floor_.strips.count / 2.0;
    const auto first = static_cast<std::int32_t>(std::ceil(std::max(span.from + middle, 0.0)));
    const auto end = static_cast<std::int32_t>(
        std::floor(std::min<double>(span.to + middle, floor_.strips.count)));
    if (first >= end) return;
    for (std::int32_t i = FindRoot(next_free_, first); i < end; i = FindRoot(next_free_, i)) {
      heights[i] = height;
      next_free_[static_cast<std::size_t>(i)] = i + 1;
    }
  }

  const SkylineNet& net_;
  SkylineFloor& floor_;
  std::vector<Lowered> order_;  // falling
  std::vector<std::int32_t> parent_;
  std::vector<Span> spans_;
  std::vector<std::int32_t> next_free_;  // strips without a height: themselves
};

}  // namespace

LineStrips LineStrips::Of(double columns, double rows) {
  const double reach = std::hypot(columns, rows) / 2;
  LineStrips strips;
  strips.directions =
      std::max(kLeastDirections, static_cast<int>(std::ceil(std::numbers::pi * reach / kSpread)));
  strips.column = columns / 2;
  strips.row = rows / 2;
  // Twice a whole number of cells: the middle is between two strips.
  strips.count = 2 * (static_cast<std::int32_t>(std::ceil(reach)) + 2);
  // A sine's excess over its ends: reach (1 - cos(half the range)); and what floats round.
  const double half = std::numbers::pi / strips.directions / 2;
  strips.slack = 1.01 * reach * (1 - std::cos(half)) + 1e-6 * (reach + 1);
  return strips;
}

DirectionRange LineStrips::Range(int k) const {
  const double step = std::numbers::pi / directions;
  return DirectionRange::Of(k * step, (k + 1) * step);
}

std::int32_t LineStrips::StripOf(double offset) const {
  const double place = std::clamp(offset + count / 2.0, 0.0, static_cast<double>(count - 1));
  return static_cast<std::int32_t>(place);
}

double SkylineFloor::Least(int k, std::int32_t first, std::int32_t last) const {
  const float* row = &heights[static_cast<std::size_t>(k) * static_cast<std::size_t>(strips.count)];
  return *std::min_element(row + first, row + last + 1);
}

Result<SkylineFloor> FindSkylineFloor(const SkylineNet& net, const std::vector<double>& lowered_m,
                                      const LineStrips& strips, const RunControl& control) {
  SkylineFloor floor;
  floor.strips = strips;
  floor.heights.assign(
      static_cast<std::size_t>(strips.directions) * static_cast<std::size_t>(strips.count),
      kUnknown);
  FloorFinder finder(net, lowered_m, floor);
  for (int k = 0; k < strips.directions; ++k) {
    if (control.StopRequested()) {
      return Error{ErrorCode::kCancelled, "stopped while bounding the skyline from below"};
    }
    finder.FindRange(k);
  }
  return floor;
}

}  // namespace farhorizon
