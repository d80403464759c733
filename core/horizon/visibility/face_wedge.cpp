// The wedge of directions that the two faces beside an edge leave free (core/horizon/README.md,
// theorem 7):
//
//                    last         first      `first`: the contour of the face on the left. Further
//                       \         /          clockwise, that face rises above the edge's point p.
//            left face   \  free /           `last`: the opposite of the contour of the face on
//                         \     /            the right. Further counter-clockwise, the line comes
//                          \   /             from higher ground on the right.
//     low ----------------- p ----------------> high
//                          /   \             One face missing: its contour is the edge itself.
//            right face   /     \            A valley: last comes before first, nothing is free.
#include "core/horizon/visibility/face_wedge.h"

#include <utility>

#include "core/geometry/direction.h"

namespace farhorizon {

std::optional<FaceWedge> WedgeOf(const Point3i& low, const Point3i& high,
                                 const std::optional<Point3i>& c, const std::optional<Point3i>& d) {
  const std::int64_t climb = std::int64_t{high.z} - low.z;
  if (climb == 0) return std::nullopt;
  const ShortVector along{high.x - low.x, high.y - low.y};
  FaceWedge wedge{along, {-along.x, -along.y}};
  for (const std::optional<Point3i>& third : {c, d}) {
    if (!third) continue;
    // climb * to - rise * along has no rise in the face: a contour, towards the third post.
    const ShortVector to{third->x - low.x, third->y - low.y};
    const std::int64_t rise = std::int64_t{third->z} - low.z;
    const ShortVector contour{climb * to.x - rise * along.x, climb * to.y - rise * along.y};
    if (CrossSign(along, to) > 0) {
      wedge.first = contour;
    } else {
      wedge.last = {-contour.x, -contour.y};
    }
  }
  if (CrossSign(wedge.first, wedge.last) <= 0) return std::nullopt;
  return wedge;
}

std::optional<FaceWedge> WedgeOf(const Terrain& terrain, Edge edge) {
  const Terrain::Faces faces = terrain.FacesOf(edge);
  const auto point = [&terrain](const std::optional<VertexId>& v) -> std::optional<Point3i> {
    return v ? std::optional(terrain.Point(*v)) : std::nullopt;
  };
  Point3i low = terrain.Point(edge.a);
  Point3i high = terrain.Point(edge.b);
  if (low.z > high.z) std::swap(low, high);
  return WedgeOf(low, high, point(faces.left), point(faces.right));
}

}  // namespace farhorizon
