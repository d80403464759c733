#pragma once

#include <array>
#include <optional>
#include <vector>

#include "core/terrain/dem.h"
#include "core/terrain/mesh.h"

namespace farhorizon {

/// The part of a DEM that a mesh covers, as a DEM of its own.
///
/// dem: the least box of columns and rows around the covered posts, the others without data.
/// first: its first column and row in the whole.
struct CoveredPart {
  Dem dem;
  std::array<std::int32_t, 2> first = {0, 0};
};

/// nullopt where the mesh covers the whole DEM, except for posts beside covered ones: a rim that
/// has shrunk is an error of the mesh, and the DEM's own rim is what it is held to.
///
/// heights: of HeightsOverPosts, not all NaN.
std::optional<CoveredPart> PartUnder(const std::vector<double>& heights, const Dem& dem);

/// Posts with data that the mesh leaves out within what it covers: in holes where the DEM has none.
/// heights: as above. Cost: O(posts).
std::int64_t CountHolePosts(const std::vector<double>& heights, const Dem& dem);

/// Moves a mesh into the grid of the part.
void MoveInto(const CoveredPart& part, GridMesh& mesh);

}  // namespace farhorizon
