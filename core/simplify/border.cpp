#include "core/simplify/border.h"

#include <cmath>
#include <cstdint>

namespace farhorizon {
namespace {

/// One side of the tile: `count` posts from `first`, `step` apart.
struct Side {
  VertexId first;
  VertexId step;
  std::int32_t count;
};

class SideSimplifier {
 public:
  SideSimplifier(const Dem& dem, double tolerance, double longest, std::vector<bool>& kept)
      : dem_(dem), tolerance_(tolerance), longest_(longest), kept_(kept) {}

  void Simplify(const Side& side) {
    std::int32_t from = 0;
    while (from < side.count) {
      if (!dem_.HasData(At(side, from))) {
        ++from;
        continue;
      }
      std::int32_t to = from;
      while (to + 1 < side.count && dem_.HasData(At(side, to + 1))) ++to;
      Keep(side, from);
      Keep(side, to);
      SplitRun(side, from, to);
      from = to + 1;
    }
  }

 private:
  static VertexId At(const Side& side, std::int32_t i) { return side.first + i * side.step; }
  std::int64_t Height(const Side& side, std::int32_t i) const {
    return dem_.heights[static_cast<std::size_t>(At(side, i))];
  }
  void Keep(const Side& side, std::int32_t i) {
    kept_[static_cast<std::size_t>(At(side, i))] = true;
  }

  void SplitRun(const Side& side, std::int32_t from, std::int32_t to) {
    std::vector<std::pair<std::int32_t, std::int32_t>> open = {{from, to}};
    while (!open.empty()) {
      const auto [a, b] = open.back();
      open.pop_back();
      if (b - a < 2) continue;
      // The farthest post, the first of several; the middle of a run that is straight.
      std::int32_t farthest = a + (b - a) / 2;
      std::int64_t most = 0;
      const std::int64_t rise = Height(side, b) - Height(side, a);
      for (std::int32_t i = a + 1; i < b; ++i) {
        const std::int64_t off =
            std::abs((Height(side, i) - Height(side, a)) * (b - a) - rise * (i - a));
        if (off > most) {
          most = off;
          farthest = i;
        }
      }
      const bool far = static_cast<double>(most) > tolerance_ * (b - a);
      const bool long_chord = longest_ > 0 && b - a > longest_;
      if (!far && !long_chord) continue;
      Keep(side, farthest);
      open.emplace_back(a, farthest);
      open.emplace_back(farthest, b);
    }
  }

  const Dem& dem_;
  double tolerance_;
  double longest_;
  std::vector<bool>& kept_;
};

}  // namespace

std::vector<bool> OutlinePosts(const Terrain& terrain) {
  std::vector<bool> outline(static_cast<std::size_t>(terrain.post_count()), false);
  for (const Edge& edge : terrain.Edges()) {
    const Terrain::Faces faces = terrain.FacesOf(edge);
    if (faces.left && faces.right) continue;
    outline[static_cast<std::size_t>(edge.a)] = true;
    outline[static_cast<std::size_t>(edge.b)] = true;
  }
  return outline;
}

std::vector<bool> KeptSidePosts(const Dem& dem, double tolerance, double longest) {
  std::vector<bool> kept(dem.heights.size(), false);
  SideSimplifier simplifier(dem, tolerance, longest, kept);
  const VertexId last_row = (dem.rows - 1) * dem.columns;
  simplifier.Simplify({0, 1, dem.columns});
  simplifier.Simplify({last_row, 1, dem.columns});
  simplifier.Simplify({0, dem.columns, dem.rows});
  simplifier.Simplify({dem.columns - 1, dem.columns, dem.rows});
  return kept;
}

}  // namespace farhorizon
