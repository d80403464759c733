#include "core/horizon/visibility/segment_index.h"

#include <algorithm>
#include <limits>
#include <utility>

#include "core/base/result.h"

namespace farhorizon {

namespace {

// The smallest cells are 2^2 posts wide: then a tile has about as many nodes as horizon edges. Any
// value is sound.
constexpr int kSmallestCellBits = 2;

constexpr std::int32_t kLowest = std::numeric_limits<std::int32_t>::min();
constexpr std::int32_t kHighest = std::numeric_limits<std::int32_t>::max();

}  // namespace

SegmentIndex::SegmentIndex(std::int32_t columns, std::int32_t rows) {
  const Node empty{kHighest, kHighest, kLowest, kLowest, kLowest, -1};
  for (int bits = kSmallestCellBits;; ++bits) {
    Tier tier;
    tier.columns = ((columns - 1) >> bits) + 1;
    tier.rows = ((rows - 1) >> bits) + 1;
    tier.nodes.assign(static_cast<std::size_t>(tier.columns) * static_cast<std::size_t>(tier.rows),
                      empty);
    const bool root = tier.columns == 1 && tier.rows == 1;
    tiers_.push_back(std::move(tier));
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
  std::size_t tier = 0;
  while (tier + 1 < tiers_.size() &&
         length > (std::int32_t{1} << (static_cast<int>(tier) + kSmallestCellBits))) {
    ++tier;
  }
  const std::size_t home = tier;
  for (; tier < tiers_.size(); ++tier) {
    const int bits = static_cast<int>(tier) + kSmallestCellBits;
    const std::int32_t x = std::clamp((min_x + max_x) >> (bits + 1), 0, tiers_[tier].columns - 1);
    const std::int32_t y = std::clamp((min_y + max_y) >> (bits + 1), 0, tiers_[tier].rows - 1);
    Node& node =
        tiers_[tier]
            .nodes[static_cast<std::size_t>(y) * static_cast<std::size_t>(tiers_[tier].columns) +
                   static_cast<std::size_t>(x)];
    node.min_x = std::min(node.min_x, min_x);
    node.min_y = std::min(node.min_y, min_y);
    node.max_x = std::max(node.max_x, max_x);
    node.max_y = std::max(node.max_y, max_y);
    node.top = std::max(node.top, item.high.z);
    if (tier == home) item.next = std::exchange(node.first, id);
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
