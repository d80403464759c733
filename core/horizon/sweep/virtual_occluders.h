#pragma once

#include <cstdint>
#include <vector>

#include "core/geometry/convex_polygon.h"
#include "core/geometry/segment.h"

namespace farhorizon {

/// Appends to `virtual_occluders` a horizontal segment at `height` for each silhouette, except
/// those that wider ones occlude as seen from `viewpoint`: the fewer segments, the faster the
/// decision. No answer depends on the selection, so it is made in floating point.
void SelectVirtualOccluders(Point2i viewpoint, std::int32_t height,
                            const std::vector<ConvexPolygon::Silhouette>& silhouettes,
                            std::vector<Segment>& virtual_occluders);

}  // namespace farhorizon
