#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "core/horizon/horizon.h"
#include "core/io/horizon_features.h"
#include "core/pipeline/terrain_input.h"
#include "core/pipeline/verify/claims.h"
#include "core/terrain/mesh.h"

namespace farhorizon {

/// What horizon.geojson says of each edge, by the terrain's own posts; features whose posts are
/// outside the grid are left out. level_kept: -1 for none. undecided: how many of the edges are.
struct PublishedEdges {
  std::vector<Edge> edges;
  std::vector<int> level_kept;
  std::int64_t undecided = 0;
};

/// Checks each feature by itself: its posts and their positions, its witness, or, where that could
/// not be written, whether a line of sight touches it; and that random lines
/// have their skyline on the set. source: where they are from, for the claims' texts.
/// Cost: O(columns + rows) a witness; 1000 times the terrain's edges.
PublishedEdges VerifyFeatures(const TerrainInput& input,
                              const std::vector<HorizonFeature>& features,
                              const std::string& source, Claims& claims);

/// Checks that the claimed edges are those of `horizon`, in any order.
void VerifySet(const std::vector<Edge>& claimed, const Horizon& horizon, Claims& claims);

}  // namespace farhorizon
