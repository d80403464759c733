// A surface of triangles is highest over a line at an edge, or at an end of the line's way over it,
// which is an edge too: so H is the greatest height at which the line crosses any edge, by
// definition and with nothing left out. Cost: for each direction, every edge once and every
// crossing once.
#include "skylines.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

namespace farhorizon::peers {

namespace {

constexpr double kNothing = -std::numeric_limits<double>::infinity();

}  // namespace

Skylines::Skylines(const Grid& grid, int directions, int lines_per_cell) {
  const std::vector<Segment> edges = EdgesOf(FullMesh(grid));
  const double width = grid.columns - 1, height = grid.rows - 1;
  for (int k = 0; k < directions; ++k) {
    constexpr double kGolden = 0.6180339887498949;  // the most even spread for any number
    const double angle = std::fmod(k * kGolden + 0.1234567, 1.0) * std::numbers::pi;
    Pencil pencil{};
    pencil.along_x = -std::sin(angle) * lines_per_cell;
    pencil.along_y = std::cos(angle) * lines_per_cell;
    const double at_x = pencil.along_x * width, at_y = pencil.along_y * height;
    pencil.first = std::min(0., at_x) + std::min(0., at_y);
    const double last = std::max(0., at_x) + std::max(0., at_y);
    pencil.dem = Over(pencil, edges, static_cast<std::size_t>(last - pencil.first) + 1);
    pencils_.push_back(std::move(pencil));
  }
}

SilhouetteErrors Skylines::ErrorsOf(const Mesh& mesh) const {
  const std::vector<Segment> edges = EdgesOf(mesh);
  SilhouetteErrors errors;
  double squares = 0;
  for (const Pencil& pencil : pencils_) {
    const std::vector<Skyline> own = Over(pencil, edges, pencil.dem.size());
    for (std::size_t i = 0; i < own.size(); ++i) {
      const Skyline &dem = pencil.dem[i], &level = own[i];
      const bool over_dem = dem.height > kNothing, over_level = level.height > kNothing;
      if (over_dem != over_level) ++errors.missed;
      if (!over_dem || !over_level) continue;
      const double error = std::abs(dem.height - level.height);
      double& greatest = dem.rim || level.rim ? errors.rim_max : errors.max;
      greatest = std::max(greatest, error);
      squares += error * error;
      ++errors.lines;
    }
  }
  errors.rms = std::sqrt(squares / static_cast<double>(std::max<std::int64_t>(errors.lines, 1)));
  return errors;
}

std::vector<Skylines::Segment> Skylines::EdgesOf(const Mesh& mesh) {
  std::vector<std::pair<std::int32_t, std::int32_t>> ends;
  ends.reserve(3 * mesh.triangles.size());
  for (const auto& t : mesh.triangles)
    for (const auto& [a, b] : {std::pair{t[0], t[1]}, {t[1], t[2]}, {t[2], t[0]}})
      ends.emplace_back(std::min(a, b), std::max(a, b));
  std::sort(ends.begin(), ends.end());
  std::vector<Segment> edges;
  for (std::size_t i = 0, next = 0; i < ends.size(); i = next) {
    while (next < ends.size() && ends[next] == ends[i]) ++next;
    const auto vertex = [&](std::int32_t v) { return mesh.vertices[static_cast<std::size_t>(v)]; };
    edges.push_back({vertex(ends[i].first), vertex(ends[i].second), next == i + 1});
  }
  return edges;
}

std::vector<Skylines::Skyline> Skylines::Over(const Pencil& pencil,
                                              const std::vector<Segment>& edges,
                                              std::size_t lines) {
  std::vector<Skyline> skylines(lines, {kNothing, false});
  for (const Segment& edge : edges) {
    double from = pencil.along_x * edge.a.x + pencil.along_y * edge.a.y - pencil.first;
    double to = pencil.along_x * edge.b.x + pencil.along_y * edge.b.y - pencil.first;
    double low = edge.a.z, high = edge.b.z;
    if (from > to) {
      std::swap(from, to);
      std::swap(low, high);
    }
    const double begin = std::max(0., std::ceil(from));
    const double end = std::min(static_cast<double>(lines) - 1, std::floor(to));
    const double rise = to > from ? (high - low) / (to - from) : 0;
    for (double line = begin; line <= end; ++line) {
      Skyline& skyline = skylines[static_cast<std::size_t>(line)];
      const double height = low + rise * (line - from);
      if (height > skyline.height) skyline = {height, edge.rim};
    }
  }
  return skylines;
}

}  // namespace farhorizon::peers
