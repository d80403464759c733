#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "core/pipeline/terrain_tiles/globe_mesh.h"

namespace farhorizon {

/// A coordinate of the lattice.
enum class Axis { kX, kY };

/// Cuts a part along the line on which `axis` is `at`. Result: what is at lesser coordinates, what
/// is at greater ones.
///
/// New vertices, appended to `vertices`, belong to both halves, so that these meet; where an edge
/// was cut before, all pieces of a level have the same vertex. A wall that lies on the line goes
/// with the ground whose side it is.
std::array<GlobePart, 2> SplitPart(const GlobePart& part, Axis axis, std::int64_t at,
                                   std::vector<GlobeVertex>& vertices);

}  // namespace farhorizon
