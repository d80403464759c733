#pragma once

#include <vector>

#include "core/io/horizon_chains.h"
#include "core/pipeline/terrain_input.h"
#include "core/pipeline/verify/claims.h"
#include "core/pipeline/verify/verify_features.h"

namespace farhorizon {

/// Checks the chains of horizon.geojson against the edges that were found again: their posts and
/// where these are, azimuths and weights. Levels are left to the caller.
/// chains: as they were read; each post is the nearest to its point. found: one for each edge of
/// the horizon.
PublishedEdges VerifyChains(const TerrainInput& input, std::vector<HorizonChain> chains,
                            const std::vector<HorizonFeature>& found, Claims& claims);

}  // namespace farhorizon
