#include "core/measure/horizon_index.h"

#include <algorithm>

#include "core/terrain/border.h"

namespace farhorizon {

namespace {

// Which bit stands for the edge from a post to one after it, by the difference of numbers.
std::uint8_t BitOf(VertexId difference, std::int32_t columns) {
  if (difference == 1) return 1;
  if (difference == columns) return 2;
  return difference == columns + 1 ? 4 : 8;
}

}  // namespace

HorizonIndex::HorizonIndex(const Terrain& terrain, const Horizon& horizon)
    : horizon_(&horizon),
      columns_(terrain.dem().columns),
      bits_(static_cast<std::size_t>(terrain.post_count()), 0) {
  outline_posts_ = OutlinePosts(terrain);
  inner_.reserve(horizon.edges.size());
  for (const HorizonEdge& h : horizon.edges) {
    const bool touches = outline_posts_[static_cast<std::size_t>(h.edge.a)] ||
                         outline_posts_[static_cast<std::size_t>(h.edge.b)];
    inner_.push_back(touches ? 0 : 1);
    bits_[static_cast<std::size_t>(h.edge.a)] |= BitOf(h.edge.b - h.edge.a, columns_);
  }
}

std::int32_t HorizonIndex::Find(VertexId a, VertexId b) const {
  if ((bits_[static_cast<std::size_t>(a)] & BitOf(b - a, columns_)) == 0) return kNoneThere;
  const auto found =
      std::lower_bound(horizon_->edges.begin(), horizon_->edges.end(), Edge{a, b},
                       [](const HorizonEdge& h, const Edge& edge) { return h.edge < edge; });
  if (found == horizon_->edges.end() || found->edge != Edge{a, b}) return kNoneThere;
  return static_cast<std::int32_t>(found - horizon_->edges.begin());
}

}  // namespace farhorizon
