#pragma once

#include <vector>

#include "core/horizon/lines_of_sight/strip_cell.h"
#include "core/horizon/visibility/segment_index.h"
#include "core/horizon/visibility/target_segment.h"

namespace farhorizon {

/// The lines through an edge, at its height, above which a segment rises: cells of the edge's strip
/// that do not overlap. Exact, up to a set of lines without interior points.
/// Requires: in plan the segment does not lie over the edge, except at its ends.
std::vector<StripCell> CellsOccludedBy(const SegmentIndex::Item& item, const TargetSegment& edge);

}  // namespace farhorizon
