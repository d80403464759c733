#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "core/horizon/visibility/occluder_set.h"
#include "core/terrain/terrain.h"

namespace farhorizon {

/// Anything that finds the horizon edges of a terrain, sorted.
using HorizonFinder = std::function<std::vector<Edge>(const Terrain&)>;

/// `find` gives the edges of the definition. A DEM without any surface matches. On failure: the
/// missing and the extra edges of a shrunk DEM, its drawing to be put into a test, and the name of
/// an SVG with the missing edges red, the extra ones blue, the common ones black.
testing::AssertionResult MatchesBruteForce(const Dem& dem, const HorizonFinder& find);

/// Over random plan lines, the greatest height of the terrain is attained by one of `edges`; exact.
/// Half the lines run through two random points of the plan, half through a point of a random edge
/// in a random direction.
testing::AssertionResult MaximiserIsIn(const Terrain& terrain, const std::vector<Edge>& edges,
                                       int lines, std::uint32_t seed);

/// The line of `witness` crosses `segment` at its t, in (0, 1), and meets nothing of `obstacles`
/// above (kPass), or at or above (kBlock), that point: from the definition, exact.
testing::AssertionResult LineOfSightIsClear(const Witness& witness, const Segment& segment,
                                            const std::vector<Segment>& obstacles, Ties ties);

/// The edges of a terrain as segments.
std::vector<Segment> SegmentsOf(const Terrain& terrain, const std::vector<Edge>& edges);

/// Segments as they are written in a test.
std::string DrawSegments(const std::vector<Segment>& segments);

}  // namespace farhorizon
