#pragma once

#include <vector>

#include "core/simplify/lod_chain.h"
#include "core/simplify/sides/side_posts.h"
#include "core/simplify/work/workpiece.h"

namespace farhorizon {

/// The level that the workpiece is now. sides: the heights of the sides' posts; others have the
/// mesh's.
Lod LevelOf(const Workpiece& work, const std::vector<SidePosts::Height>& sides);

}  // namespace farhorizon
