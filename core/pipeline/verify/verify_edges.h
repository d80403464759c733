#pragma once

#include <vector>

#include "core/horizon/horizon.h"
#include "core/io/horizon_features.h"
#include "core/pipeline/terrain_input.h"
#include "core/pipeline/verify/claims.h"

namespace farhorizon {

/// What is done of Stage::kVerify before VerifySights, and with it; the rest is the levels'.
inline constexpr double kVerifiedBeforeSights = 0.9;
inline constexpr double kVerifiedWithSights = 0.95;

/// Checks the azimuths, spans and weights of published horizon edges: against those found again, and
/// by lines of sight. Random lines find their skyline nowhere outside them; from within an edge's
/// widest azimuth it is seen, from within the widest gap between them it is not.
///
/// features: one for each edge of `horizon`, in its order; another number or order is a false claim.
/// Cost: that of FindLinesOfSight, and 2000 times the number of edges.
Status VerifyEdges(const TerrainInput& source, const Horizon& horizon,
                   const std::vector<HorizonFeature>& features, int threads, const Watch& watch,
                   Claims& claims);

}  // namespace farhorizon
