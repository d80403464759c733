#include "core/horizon/sweep/virtual_occluders.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace farhorizon {
namespace {

struct Shade {
  double from;  // keys as in direction.h: the half turn is 2
  double width;
  const ConvexPolygon::Silhouette* silhouette;
};

constexpr double kHalfTurn = 2;

double KeyOf(Point2i eye, Point2i p) {
  double x = p.x - eye.x;
  double y = p.y - eye.y;
  if (y < 0 || (y == 0 && x < 0)) {
    x = -x;
    y = -y;
  }
  return 1 - x / (std::abs(x) + y);
}

// Whether an interval of directions, which may cross the start, is inside one of those that are kept.
bool Hidden(const std::vector<Shade>& kept, const Shade& shade) {
  return std::any_of(kept.begin(), kept.end(), [&shade](const Shade& k) {
    double start = shade.from - k.from;
    if (start < 0) start += kHalfTurn;
    return start + shade.width <= k.width;
  });
}

}  // namespace

void SelectVirtualOccluders(Point2i eye, std::int32_t level,
                            const std::vector<ConvexPolygon::Silhouette>& silhouettes,
                            std::vector<Segment>& virtual_occluders) {
  std::vector<Shade> shades;
  for (const ConvexPolygon::Silhouette& s : silhouettes) {
    const double from = KeyOf(eye, s.right);
    double width = KeyOf(eye, s.left) - from;
    if (width < 0) width += kHalfTurn;
    if (s.right != s.left) shades.push_back({from, width, &s});
  }
  std::sort(shades.begin(), shades.end(), [](const Shade& a, const Shade& b) {
    return std::pair(-a.width, a.from) < std::pair(-b.width, b.from);
  });
  std::vector<Shade> kept;
  for (const Shade& shade : shades) {
    if (Hidden(kept, shade)) continue;
    kept.push_back(shade);
    const ConvexPolygon::Silhouette& s = *shade.silhouette;
    virtual_occluders.push_back({{s.right.x, s.right.y, level}, {s.left.x, s.left.y, level}});
  }
}

}  // namespace farhorizon
