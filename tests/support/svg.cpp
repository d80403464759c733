#include "tests/support/svg.h"

#include <sstream>

namespace farhorizon {
namespace {

constexpr int kCell = 48;  // pixels

int Pixel(std::int32_t coordinate) { return kCell / 2 + coordinate * kCell; }

void DrawEdges(const Terrain& terrain, const SvgLayer& layer, int width, std::ostream& out) {
  for (const Edge edge : layer.edges) {
    const Point3i a = terrain.Point(edge.a);
    const Point3i b = terrain.Point(edge.b);
    out << "<line x1='" << Pixel(a.x) << "' y1='" << Pixel(a.y) << "' x2='" << Pixel(b.x)
        << "' y2='" << Pixel(b.y) << "' stroke='" << layer.colour << "' stroke-width='" << width
        << "'/>\n";
  }
}

}  // namespace

std::string DrawSvg(const Terrain& terrain, const std::vector<SvgLayer>& layers) {
  std::ostringstream out;
  const Dem& dem = terrain.dem();
  out << "<svg xmlns='http://www.w3.org/2000/svg' width='" << dem.columns * kCell << "' height='"
      << dem.rows * kCell << "'>\n<rect width='100%' height='100%' fill='white'/>\n";
  DrawEdges(terrain, {"lightgrey", terrain.Edges()}, 1, out);
  for (const SvgLayer& layer : layers) DrawEdges(terrain, layer, 3, out);
  for (VertexId v = 0; v < terrain.post_count(); ++v) {
    if (!dem.HasData(v)) continue;
    const Point3i p = terrain.Point(v);
    out << "<text x='" << Pixel(p.x) + 2 << "' y='" << Pixel(p.y) - 2
        << "' font-size='11' font-family='monospace'>" << p.z << "</text>\n";
  }
  out << "</svg>\n";
  return out.str();
}

}  // namespace farhorizon
