#pragma once

#include "core/base/result.h"
#include "core/pipeline/georeference.h"
#include "core/terrain/terrain.h"

namespace farhorizon {

/// The greatest distance of a post from the DEM's middle, degrees of arc.
///
/// The DEM is taken for a plane, on which all summits may see one another. On the globe two summits
/// of 9 km see each other over up to 2 acos(R / (R + 9 km)) = 6.1 degrees of sea. The bound is
/// thrice that: tiles of 20 x 20 degrees are taken, continents are not.
inline constexpr double kMostDegreesFromMiddle = 20;

/// Checks on a sample of posts, the outermost among them, that the DEM has a place on the globe
/// that one local frame and positions of kMaxLatticeBits can show.
/// Errors: kUnsupportedData: kind "too-large-extent"; kind "cells-too-narrow" where posts lie
///   closer to one another than positions can tell, as at a pole; kind "outside-crs" where posts
///   are beyond a pole, do not come back from the globe, or have coordinates that look like the
///   degrees of another system; each with a remedy.
/// Cost: O(posts) for finding those with data, a few thousand points through PROJ.
Status CheckPlacement(const Terrain& terrain, const Georeference& georeference);

}  // namespace farhorizon
