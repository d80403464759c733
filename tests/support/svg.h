#pragma once

#include <string>
#include <vector>

#include "core/terrain/terrain.h"

namespace farhorizon {

/// Edges to be drawn in one colour.
struct SvgLayer {
  std::string colour;
  std::vector<Edge> edges;
};

/// A picture of a terrain from above, its edges grey, `layers` over them, heights beside the posts.
std::string DrawSvg(const Terrain& terrain, const std::vector<SvgLayer>& layers);

}  // namespace farhorizon
