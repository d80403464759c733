#include "core/horizon/visibility/segment_index.h"

#include <algorithm>
#include <limits>
#include <utility>

#include "core/base/result.h"

namespace farhorizon {
namespace {

// Cells of 2^2 posts a side at the lowest level: about as many nodes as a tile has horizon edges.
constexpr int kSmallestCellBits = 2;

constexpr std::int32_t kLowest = std::numeric_limits<std::int32_t>::min();
constexpr std::int32_t kHighest = std::numeric_limits<std::int32_t>::max();

}  // namespace

SegmentIndex::SegmentIndex(std::int32_t columns, std::int32_t rows) {
  const Node empty{kHighest, kHighest, kLowest, kLowest, kLowest, -1};
  for (int bits = kSmallestCellBits;; ++bits) {
    Level level;
    level.columns = ((columns - 1) >> bits) + 1;
    level.rows = ((rows - 1) >> bits) + 1;
    level.nodes.assign(
        static_cast<std::size_t>(level.columns) * static_cast<std::size_t>(level.rows), empty);
    const bool root = level.columns == 1 && level.rows == 1;
    levels_.push_back(std::move(level));
    if (root) break;
  }
}

std::int32_t SegmentIndex::Insert(const Segment& segment) {
  Item item;
  item.low = segment.a.z <= segment.b.z ? segment.a : segment.b;
  item.high = segment.a.z <= segment.b.z ? segment.b : segment.a;
  Check(item.low.x != item.high.x || item.low.y != item.high.y, "a segment has a length in plan");
  const auto id = static_cast<std::int32_t>(items_.size());
  const auto [min_x, max_x] = std::minmax(item.low.x, item.high.x);
  const auto [min_y, max_y] = std::minmax(item.low.y, item.high.y);
  const std::int32_t length = std::max(max_x - min_x, max_y - min_y);
  std::size_t level = 0;
  while (level + 1 < levels_.size() &&
         length > (std::int32_t{1} << (static_cast<int>(level) + kSmallestCellBits))) {
    ++level;
  }
  const std::size_t home = level;
  for (; level < levels_.size(); ++level) {
    const int bits = static_cast<int>(level) + kSmallestCellBits;
    const std::int32_t x = std::clamp((min_x + max_x) >> (bits + 1), 0, levels_[level].columns - 1);
    const std::int32_t y = std::clamp((min_y + max_y) >> (bits + 1), 0, levels_[level].rows - 1);
    Node& node =
        levels_[level]
            .nodes[static_cast<std::size_t>(y) * static_cast<std::size_t>(levels_[level].columns) +
                   static_cast<std::size_t>(x)];
    node.min_x = std::min(node.min_x, min_x);
    node.min_y = std::min(node.min_y, min_y);
    node.max_x = std::max(node.max_x, max_x);
    node.max_y = std::max(node.max_y, max_y);
    node.top = std::max(node.top, item.high.z);
    if (level == home) item.next = std::exchange(node.first, id);
  }
  items_.push_back(item);
  ++alive_;
  return id;
}

void SegmentIndex::Erase(std::int32_t id) {
  Item& item = items_[static_cast<std::size_t>(id)];
  Check(item.alive, "a segment is erased once");
  item.alive = false;
  --alive_;
}

}  // namespace farhorizon
