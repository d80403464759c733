#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "core/geometry/convex_polygon.h"
#include "core/geometry/segment.h"

namespace farhorizon {

/// The most virtual occluders of one edge: they bound the memory of ground with many hulls. Any
/// value is sound; on real DEMs few edges have more than this.
inline constexpr std::size_t kMostVirtualOccluders = 24;

/// Appends to `virtual_occluders` a horizontal segment at `height` for each silhouette, except
/// those that wider ones occlude as seen from `viewpoint`; of more than kMostVirtualOccluders the
/// widest. The fewer segments, the faster the decision. No answer depends on the selection, so it
/// is made in floating point.
void SelectVirtualOccluders(Point2i viewpoint, std::int32_t height,
                            const std::vector<ConvexPolygon::Silhouette>& silhouettes,
                            std::vector<Segment>& virtual_occluders);

}  // namespace farhorizon
