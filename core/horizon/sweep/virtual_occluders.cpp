#include "core/horizon/sweep/virtual_occluders.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace farhorizon {

namespace {

// The directions that a silhouette takes. They may go on at the start of the half turn.
struct SilhouetteArc {
  double from;  // keys as in direction.h: the half turn is 2
  double width;
  const ConvexPolygon::Silhouette* silhouette;
};

constexpr double kHalfTurn = 2;

double KeyOf(Point2i viewpoint, Point2i p) {
  double x = p.x - viewpoint.x;
  double y = p.y - viewpoint.y;
  if (y < 0 || (y == 0 && x < 0)) {
    x = -x;
    y = -y;
  }
  return 1 - x / (std::abs(x) + y);
}

bool IsInsideOneOf(const std::vector<SilhouetteArc>& wider, const SilhouetteArc& arc) {
  return std::any_of(wider.begin(), wider.end(), [&arc](const SilhouetteArc& w) {
    double start = arc.from - w.from;
    if (start < 0) start += kHalfTurn;
    return start + arc.width <= w.width;
  });
}

}  // namespace

void SelectVirtualOccluders(Point2i viewpoint, std::int32_t height,
                            const std::vector<ConvexPolygon::Silhouette>& silhouettes,
                            std::vector<Segment>& virtual_occluders) {
  std::vector<SilhouetteArc> arcs;
  for (const ConvexPolygon::Silhouette& s : silhouettes) {
    const double from = KeyOf(viewpoint, s.right);
    double width = KeyOf(viewpoint, s.left) - from;
    if (width < 0) width += kHalfTurn;
    if (s.right != s.left) arcs.push_back({from, width, &s});
  }
  std::sort(arcs.begin(), arcs.end(), [](const SilhouetteArc& a, const SilhouetteArc& b) {
    return std::pair(-a.width, a.from) < std::pair(-b.width, b.from);
  });
  std::vector<SilhouetteArc> kept;
  for (const SilhouetteArc& arc : arcs) {
    if (kept.size() == kMostVirtualOccluders) break;
    if (IsInsideOneOf(kept, arc)) continue;
    kept.push_back(arc);
    const ConvexPolygon::Silhouette& s = *arc.silhouette;
    virtual_occluders.push_back({{s.right.x, s.right.y, height}, {s.left.x, s.left.y, height}});
  }
}

}  // namespace farhorizon
