#pragma once

#include <string>
#include <vector>

#include "core/base/result.h"
#include "core/horizon/horizon.h"
#include "core/io/horizon_features.h"
#include "core/pipeline/terrain_input.h"
#include "core/pipeline/verify/verify.h"

namespace farhorizon {

/// The share of Stage::kVerify that is done before VerifyEdges, and with it; the rest is the
/// levels'.
inline constexpr double kVerifiedBeforeSights = 0.9;
inline constexpr double kVerifiedWithSights = 0.95;

/// Checks the measures of published horizon edges: against those found again, and by lines of
/// sight. Random lines have their skyline on no edge outside its azimuths and spans; along
/// directions within an edge's widest azimuth the edge is visible, along those within the widest
/// gap between its azimuths it is not.
///
/// features: one for each edge of `horizon`, in its order; any other list is a false claim.
/// found: the same with the measures that were found again. source: where `features` are from, for
/// the claims' texts.
/// Errors: those of Georeference::StepsAt. Cost: 2000 times the number of edges.
Result<std::vector<ClaimCheck>> VerifyEdges(const TerrainInput& input, const Horizon& horizon,
                                            const std::vector<HorizonFeature>& features,
                                            const std::vector<HorizonFeature>& found,
                                            const std::string& source);

}  // namespace farhorizon
