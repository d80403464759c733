#include "core/horizon/screens.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

namespace farhorizon {
namespace {

struct Shade {
  double from;   // radians, in [0, pi)
  double width;  // in [0, pi)
  const ConvexPolygon::Silhouette* silhouette;
};

double AngleOf(Point2i eye, Point2i p) {
  const double angle = std::atan2(p.y - eye.y, p.x - eye.x);
  return angle < 0 ? angle + std::numbers::pi : (angle >= std::numbers::pi ? 0 : angle);
}

// Whether an interval of directions, modulo a half turn, is inside one of those that are kept.
bool Hidden(const std::vector<Shade>& kept, const Shade& shade) {
  return std::any_of(kept.begin(), kept.end(), [&shade](const Shade& k) {
    double start = shade.from - k.from;
    if (start < 0) start += std::numbers::pi;
    return start + shade.width <= k.width;
  });
}

}  // namespace

void SelectScreens(Point2i eye, std::int32_t level,
                   std::vector<ConvexPolygon::Silhouette>& silhouettes,
                   std::vector<Segment>& screens) {
  std::vector<Shade> shades;
  for (const ConvexPolygon::Silhouette& s : silhouettes) {
    const double from = AngleOf(eye, s.right);
    double width = AngleOf(eye, s.left) - from;
    if (width < 0) width += std::numbers::pi;
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
    screens.push_back({{s.right.x, s.right.y, level}, {s.left.x, s.left.y, level}});
  }
}

}  // namespace farhorizon
