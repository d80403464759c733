// Along the axis of the plan to which the box's lines are closer, block by block: over each the
// lines reach as far across as the corners of the box do at the block's two ends, as a line's place
// there is linear in the point that it goes through and in the tangent of its direction.
#include "core/measure/segment_blocks.h"

#include <algorithm>
#include <cmath>
#include <tuple>

#include "core/base/infinity.h"

namespace farhorizon {

namespace {

// Columns or rows. Any value is sound: with smaller blocks fewer segments are found in vain, and
// more blocks are looked at.
constexpr double kBlock = 8;

}  // namespace

SegmentBlocks::SegmentBlocks(const SkylineNet& net) : found_in_(net.segments.size(), 0) {
  double end_column = -kInfinity;
  double end_row = -kInfinity;
  column_ = row_ = kInfinity;
  for (const SkylineNet::Segment& s : net.segments) {
    for (const std::int32_t i : {s.a, s.b}) {
      column_ = std::min(column_, net.Point(i).column);
      row_ = std::min(row_, net.Point(i).row);
      end_column = std::max(end_column, net.Point(i).column);
      end_row = std::max(end_row, net.Point(i).row);
    }
  }
  if (net.segments.empty()) return;
  columns_ = static_cast<std::int32_t>((end_column - column_) / kBlock) + 1;
  rows_ = static_cast<std::int32_t>((end_row - row_) / kBlock) + 1;
  for (std::size_t k = 0; k < net.segments.size(); ++k) {
    const GridPoint& a = net.Point(net.segments[k].a);
    const GridPoint& b = net.Point(net.segments[k].b);
    const auto [left, right] = std::minmax(a.column, b.column);
    const auto [top, bottom] = std::minmax(a.row, b.row);
    for (std::int32_t r = RowOf(top); r <= RowOf(bottom); ++r) {
      for (std::int32_t c = ColumnOf(left); c <= ColumnOf(right); ++c) {
        entries_.push_back(
            {r * columns_ + c, static_cast<std::int32_t>(k), std::max(a.height_m, b.height_m)});
      }
    }
  }
  std::sort(entries_.begin(), entries_.end(), [](const Entry& p, const Entry& q) {
    return std::tie(p.block, q.height_m, p.segment) < std::tie(q.block, p.height_m, q.segment);
  });
  const auto blocks = static_cast<std::size_t>(columns_) * static_cast<std::size_t>(rows_);
  starts_.assign(blocks + 1, 0);
  for (const Entry& e : entries_) ++starts_[static_cast<std::size_t>(e.block) + 1];
  for (std::size_t b = 0; b < blocks; ++b) starts_[b + 1] += starts_[b];
  highest_.assign(blocks, -kInfinity);
  for (std::size_t b = 0; b < blocks; ++b) {
    if (starts_[b] < starts_[b + 1]) highest_[b] = entries_[starts_[b]].height_m;
  }
}

std::int32_t SegmentBlocks::ColumnOf(double column) const {
  return static_cast<std::int32_t>(std::clamp((column - column_) / kBlock, 0.0, columns_ - 1.0));
}

std::int32_t SegmentBlocks::RowOf(double row) const {
  return static_cast<std::int32_t>(std::clamp((row - row_) / kBlock, 0.0, rows_ - 1.0));
}

bool SegmentBlocks::VisitBlock(std::int32_t column, std::int32_t row, double above_m,
                               const std::function<bool(std::int32_t segment)>& visit) {
  const auto block = static_cast<std::size_t>(row * columns_ + column);
  if (highest_[block] < above_m) return false;
  for (std::size_t i = starts_[block]; i < starts_[block + 1]; ++i) {
    const Entry& e = entries_[i];
    if (e.height_m < above_m) return false;
    std::uint32_t& last = found_in_[static_cast<std::size_t>(e.segment)];
    if (last == search_) continue;
    last = search_;
    if (visit(e.segment)) return true;
  }
  return false;
}

bool SegmentBlocks::Visit(const LineBox& box, double above_m,
                          const std::function<bool(std::int32_t segment)>& visit) {
  if (entries_.empty()) return false;
  if (++search_ == 0) {
    std::fill(found_in_.begin(), found_in_.end(), 0);
    search_ = 1;
  }
  // A line of normal (x, y) has the direction (y, -x).
  const DirectionRange::Normal middle = box.directions.Middle();
  const bool by_column = std::abs(middle.y) >= std::abs(middle.x);
  const auto along = [by_column](const GridPoint& p) { return by_column ? p.column : p.row; };
  const auto across = [by_column](const GridPoint& p) { return by_column ? p.row : p.column; };
  const auto tangent = [by_column](const DirectionRange::Normal& n) {
    return by_column ? -n.x / n.y : -n.y / n.x;
  };
  const double first = tangent(box.directions.first);
  const double last = tangent(box.directions.last);
  const double begin = by_column ? column_ : row_;
  const std::int32_t count = by_column ? columns_ : rows_;
  const double across_begin = by_column ? row_ : column_;
  const std::int32_t across_count = by_column ? rows_ : columns_;
  // How far across the lines reach where blocks begin.
  const auto reach = [&](std::int32_t i) {
    const double from = begin + i * kBlock - along(box.from);
    const double to = begin + i * kBlock - along(box.to);
    return std::minmax({across(box.from) + from * first, across(box.from) + from * last,
                        across(box.to) + to * first, across(box.to) + to * last});
  };
  auto [least_before, most_before] = reach(0);
  for (std::int32_t i = 0; i < count; ++i) {
    const auto [least_after, most_after] = reach(i + 1);
    const double least = std::min(least_before, least_after);
    const double most = std::max(most_before, most_after);
    least_before = least_after;
    most_before = most_after;
    // A little wider than rounding.
    const double low = (least - 1e-6 - across_begin) / kBlock;
    const double high = (most + 1e-6 - across_begin) / kBlock;
    if (high < 0 || low > across_count) continue;
    const auto j_end = static_cast<std::int32_t>(std::min(high, across_count - 1.0));
    for (auto j = static_cast<std::int32_t>(std::max(low, 0.0)); j <= j_end; ++j) {
      if (VisitBlock(by_column ? i : j, by_column ? j : i, above_m, visit)) return true;
    }
  }
  return false;
}

}  // namespace farhorizon
