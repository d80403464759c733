#pragma once

#include <cstdint>
#include <vector>

#include "core/horizon/horizon.h"
#include "core/pipeline/verify/verify_features.h"
#include "core/terrain/mesh.h"

namespace farhorizon {

/// For each horizon edge the coarsest level so far that has it, as long as no finer one has lost
/// it.
class KeptEdges {
 public:
  /// Requires: `horizon` outlives this.
  explicit KeptEdges(const Horizon& horizon)
      : horizon_(horizon), coarsest_(horizon.edges.size(), -1) {}

  /// Places of the edges that level `level` keeps, whose mesh has `edges`, rising.
  std::vector<std::int32_t> Take(int level, const std::vector<Edge>& edges);

  /// Whether `published` has this of each edge.
  [[nodiscard]] bool Are(const PublishedEdges& published) const;

 private:
  const Horizon& horizon_;
  std::vector<int> coarsest_;
};

}  // namespace farhorizon
