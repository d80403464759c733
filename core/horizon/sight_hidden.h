#pragma once

#include <vector>

#include "core/horizon/segment_index.h"
#include "core/horizon/sight_cell.h"

namespace farhorizon {

/// The lines through an edge that a segment rises above: pairs of t and a direction, as cells that do not
/// overlap; exact, up to a set without interior points. (sight_region.h)
/// Requires: the segment does not lie over the edge in plan, but at its ends.
std::vector<SightCell> CellsHiddenBy(const SegmentIndex::Item& item, const Sighted& edge);

}  // namespace farhorizon
