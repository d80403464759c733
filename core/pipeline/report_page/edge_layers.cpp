// A layer for each sector of azimuths, so that the page can show one without drawing anything.
// Edges are drawn as pixels of a palette, the weightiest last: where several lie on one pixel, it
// has the colour of the one that matters most.
#include "core/pipeline/report_page/edge_layers.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdlib>
#include <numeric>

namespace farhorizon {

namespace {

// Places in the palette: nothing, one for each degree, undecided.
constexpr std::size_t kDegrees = 180;
constexpr std::size_t kUndecided = kDegrees + 1;

std::vector<std::array<std::uint8_t, 4>> Palette() {
  std::vector<std::array<std::uint8_t, 4>> palette = {{0, 0, 0, 0}};
  for (std::size_t i = 0; i < kDegrees; ++i) {
    const auto [red, green, blue] = ColourOfAzimuth(static_cast<double>(i) + 0.5);
    palette.push_back({red, green, blue, 255});
  }
  palette.push_back({90, 90, 90, 255});
  return palette;
}

// Draws lines of a width that grows with the cells, but not as they do: one pixel where a cell is
// no larger than a pixel, three for the largest.
class Pen {
 public:
  explicit Pen(const PictureFrame& frame) : frame_(frame) {
    const double pixels_a_cell = std::min(frame.width / frame.columns, frame.height / frame.rows);
    width_ = pixels_a_cell < 1.5 ? 1 : pixels_a_cell < 6 ? 2 : 3;
  }

  void Draw(const HorizonFeature& edge, std::uint8_t colour, PalettePicture& picture) const {
    const int x1 = X(edge.a[0]);
    const int y1 = Y(edge.a[1]);
    const int x2 = X(edge.b[0]);
    const int y2 = Y(edge.b[1]);
    const int steps = std::max({std::abs(x2 - x1), std::abs(y2 - y1), 1});
    for (int i = 0; i <= steps; ++i) {
      Dot(x1 + (x2 - x1) * i / steps, y1 + (y2 - y1) * i / steps, colour, picture);
    }
  }

 private:
  [[nodiscard]] int X(std::int32_t column) const {
    const double middle = (frame_.SampleX(column) + 0.5) / frame_.samples;
    return std::clamp(static_cast<int>(std::floor(middle)), 0, frame_.width - 1);
  }
  [[nodiscard]] int Y(std::int32_t row) const {
    const double middle = (frame_.SampleY(row) + 0.5) / frame_.samples;
    return std::clamp(static_cast<int>(std::floor(middle)), 0, frame_.height - 1);
  }
  void Dot(int x, int y, std::uint8_t colour, PalettePicture& picture) const {
    const int first = -(width_ / 2);
    for (int dy = first; dy < first + width_; ++dy) {
      for (int dx = first; dx < first + width_; ++dx) {
        if (x + dx < 0 || x + dx >= frame_.width || y + dy < 0 || y + dy >= frame_.height) continue;
        picture.values[static_cast<std::size_t>(y + dy) * static_cast<std::size_t>(frame_.width) +
                       static_cast<std::size_t>(x + dx)] = colour;
      }
    }
  }

  PictureFrame frame_;
  int width_;
};

}  // namespace

std::array<EdgeLayer, kSectors + 1> DrawEdgeLayers(const std::vector<HorizonFeature>& features,
                                                   const PictureFrame& frame) {
  std::array<EdgeLayer, kSectors + 1> layers;
  const std::size_t pixels =
      static_cast<std::size_t>(frame.width) * static_cast<std::size_t>(frame.height);
  for (EdgeLayer& layer : layers) {
    layer.picture = {frame.width, frame.height, std::vector<std::uint8_t>(pixels), Palette()};
  }
  std::vector<std::size_t> order(features.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(), [&features](std::size_t i, std::size_t j) {
    return features[i].measures.line_measure_m < features[j].measures.line_measure_m;
  });
  const Pen pen(frame);
  for (const std::size_t i : order) {
    const HorizonFeature& edge = features[i];
    // An edge that is seen at one place alone, or in directions closer than are written, has none.
    const bool decided = !edge.measures.azimuths.empty();
    const double azimuth = decided ? ShownAzimuth(edge.measures.azimuths) : 0;
    EdgeLayer& layer =
        layers[decided ? static_cast<std::size_t>(SectorOfAzimuth(azimuth)) : kSectors];
    ++layer.edges;
    layer.line_measure_m += edge.measures.line_measure_m;
    pen.Draw(edge,
             static_cast<std::uint8_t>(decided ? 1 + static_cast<std::size_t>(azimuth) % kDegrees
                                               : kUndecided),
             layer.picture);
  }
  return layers;
}

}  // namespace farhorizon
