#include "core/pipeline/verify/kept_edges.h"

#include <algorithm>
#include <cstddef>
#include <map>

namespace farhorizon {

std::vector<std::int32_t> KeptEdges::Take(int level, const std::vector<Edge>& edges) {
  std::vector<std::int32_t> kept;
  for (std::size_t i = 0; i < coarsest_.size(); ++i) {
    if (coarsest_[i] != level - 1) continue;
    if (!std::binary_search(edges.begin(), edges.end(), horizon_.edges[i].edge)) continue;
    coarsest_[i] = level;
    kept.push_back(static_cast<std::int32_t>(i));
  }
  return kept;
}

bool KeptEdges::Are(const PublishedEdges& published) const {
  std::map<Edge, int> claimed;
  for (std::size_t i = 0; i < published.edges.size(); ++i) {
    claimed.emplace(published.edges[i], published.level_kept[i]);
  }
  for (std::size_t i = 0; i < coarsest_.size(); ++i) {
    const auto at = claimed.find(horizon_.edges[i].edge);
    if (at == claimed.end() || at->second != coarsest_[i]) return false;
  }
  return true;
}

}  // namespace farhorizon
