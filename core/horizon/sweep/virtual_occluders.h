#pragma once

#include <cstdint>
#include <vector>

#include "core/geometry/convex_polygon.h"
#include "core/horizon/visibility/occluder_set.h"

namespace farhorizon {

/// Appends to `virtual occluders` a level segment at `level` for each silhouette that shows from `eye` beside the
/// wider ones: the fewer, the faster a sight over them is decided. Which are left out never changes an
/// answer, so floating point is good enough to choose.
void SelectVirtualOccluders(Point2i eye, std::int32_t level,
                            const std::vector<ConvexPolygon::Silhouette>& silhouettes,
                            std::vector<Segment>& virtual_occluders);

}  // namespace farhorizon
