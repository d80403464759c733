#pragma once

#include <vector>

#include "core/horizon/lines_of_sight/strip_cell.h"
#include "core/horizon/visibility/segment_index.h"
#include "core/horizon/visibility/target_segment.h"

namespace farhorizon {

/// The lines through an edge that a segment rises above: pairs of t and a direction, as cells that do not
/// overlap; exact, up to a set without interior points. (visible_region.h)
/// Requires: the segment does not lie over the edge in plan, but at its ends.
std::vector<StripCell> CellsOccludedBy(const SegmentIndex::Item& item, const TargetSegment& edge);

}  // namespace farhorizon
