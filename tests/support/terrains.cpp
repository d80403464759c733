#include "tests/support/terrains.h"

#include <algorithm>
#include <array>

#include "tests/support/ascii_dem.h"

namespace farhorizon {
namespace {

// The standard leaves the distributions to the library; a remainder is the same everywhere.
std::int32_t Below(std::int32_t bound, std::mt19937& random) {
  return static_cast<std::int32_t>(random() % static_cast<std::uint32_t>(bound));
}

std::int32_t HeightAt(const Dem& dem, std::int32_t column, std::int32_t row) {
  return dem.heights[static_cast<std::size_t>(row) * static_cast<std::size_t>(dem.columns) +
                     static_cast<std::size_t>(column)];
}

std::int32_t& HeightAt(Dem& dem, std::int32_t column, std::int32_t row) {
  return dem.heights[static_cast<std::size_t>(row) * static_cast<std::size_t>(dem.columns) +
                     static_cast<std::size_t>(column)];
}

void LayRectangle(Dem& dem, std::int32_t max_height, bool sloped, std::mt19937& random) {
  const std::int32_t c0 = Below(dem.columns, random);
  const std::int32_t r0 = Below(dem.rows, random);
  const std::int32_t c1 = c0 + Below(dem.columns - c0, random);
  const std::int32_t r1 = r0 + Below(dem.rows - r0, random);
  const std::int32_t base = Below(max_height + 1, random);
  const std::int32_t east = sloped ? Below(3, random) - 1 : 0;
  const std::int32_t south = sloped ? Below(3, random) - 1 : 0;
  for (std::int32_t r = r0; r <= r1; ++r) {
    for (std::int32_t c = c0; c <= c1; ++c) {
      HeightAt(dem, c, r) = base + east * (c - c0) + south * (r - r0);
    }
  }
}

}  // namespace

Dem MakeDem(std::int32_t columns, std::int32_t rows,
            const std::function<std::int32_t(std::int32_t, std::int32_t)>& height) {
  Dem dem;
  dem.columns = columns;
  dem.rows = rows;
  for (std::int32_t r = 0; r < rows; ++r) {
    for (std::int32_t c = 0; c < columns; ++c) dem.heights.push_back(height(c, r));
  }
  return dem;
}

Dem Crater(bool west, bool south, bool east) {
  Dem dem = AsciiDem(R"(
      0  0  0  0  0  0  0
      0 10 10 10 10 10  0
      0 10  1  1  1 10  0
      0 10  1  8  1 10  0
      0 10  1  1  1 10  0
      0 10 10 10 10 10  0
      0  0  0  0  0  0  0)");
  if (west) HeightAt(dem, 1, 3) = 2;
  if (south) HeightAt(dem, 3, 5) = 2;
  if (east) HeightAt(dem, 5, 3) = 2;
  return dem;
}

Dem Paraboloid(std::int32_t n, int sign) {
  const std::int32_t m = n / 2;
  return MakeDem(n, n, [m, sign](std::int32_t c, std::int32_t r) {
    return sign * ((c - m) * (c - m) + (r - m) * (r - m));
  });
}

std::vector<NamedTerrain> NamedTerrains() {
  return {
      {"O1, a pyramid of five posts", AsciiDem(".0.\n010\n.0."), 4},
      {"O2, a closed crater", Crater(false, false, false), -1},
      {"O3, a crater open to the west", Crater(true, false, false), -1},
      {"O3, a crater open to the west and south", Crater(true, true, false), -1},
      {"O3, a crater open to the west and east", Crater(true, false, true), -1},
      {"O4, a plateau", AsciiDem("0000\n0550\n0550\n0000"), 14},
      {"O5, a bowl", Paraboloid(5, 1), 16},
      {"O6, a dome", Paraboloid(5, -1), 40},
  };
}

Dem RandomDem(const RandomTerrain& kind, std::mt19937& random) {
  Dem dem = MakeDem(kind.columns, kind.rows,
                    [&](std::int32_t, std::int32_t) { return Below(kind.max_height + 1, random); });
  for (int i = 0; i < kind.plateaus; ++i) LayRectangle(dem, kind.max_height, false, random);
  for (int i = 0; i < kind.planes; ++i) LayRectangle(dem, kind.max_height, true, random);
  for (std::int32_t& height : dem.heights) {
    if (Below(100, random) < kind.hole_percent) height = kNoHeight;
  }
  return dem;
}

Dem AnyRandomDem(std::int32_t min_side, std::int32_t max_side, std::mt19937& random) {
  constexpr std::array<std::int32_t, 6> kReliefs{1, 2, 3, 9, 100, 1000};
  RandomTerrain kind;
  kind.columns = min_side + Below(max_side - min_side + 1, random);
  kind.rows = min_side + Below(max_side - min_side + 1, random);
  kind.max_height = kReliefs[static_cast<std::size_t>(Below(6, random))];
  kind.hole_percent = Below(3, random) == 0 ? 15 : 0;
  kind.plateaus = Below(3, random) == 0 ? 1 + Below(2, random) : 0;
  kind.planes = Below(3, random) == 0 ? 1 + Below(2, random) : 0;
  return RandomDem(kind, random);
}

Dem FractalDem(std::int32_t n, std::int32_t relief, int roughness_percent, std::uint32_t seed) {
  std::mt19937 random(seed);
  std::int32_t side = 1;
  while (side + 1 < n) side *= 2;
  Dem dem = MakeDem(side + 1, side + 1, [](std::int32_t, std::int32_t) { return 0; });
  std::int64_t amplitude = relief;
  const auto jitter = [&] {
    return static_cast<std::int32_t>(random() % static_cast<std::uint64_t>(amplitude + 1)) -
           static_cast<std::int32_t>(amplitude / 2);
  };
  for (const std::int32_t c : {0, side}) {
    for (const std::int32_t r : {0, side}) HeightAt(dem, c, r) = Below(relief + 1, random);
  }
  for (std::int32_t step = side; step > 1; step /= 2) {
    const std::int32_t half = step / 2;
    // New posts on the sides of the coarse cells, then in their middles.
    for (std::int32_t r = 0; r <= side; r += step) {
      for (std::int32_t c = half; c <= side; c += step) {
        HeightAt(dem, c, r) =
            (HeightAt(dem, c - half, r) + HeightAt(dem, c + half, r)) / 2 + jitter();
        HeightAt(dem, r, c) =
            (HeightAt(dem, r, c - half) + HeightAt(dem, r, c + half)) / 2 + jitter();
      }
    }
    for (std::int32_t r = half; r <= side; r += step) {
      for (std::int32_t c = half; c <= side; c += step) {
        HeightAt(dem, c, r) = (HeightAt(dem, c - half, r) + HeightAt(dem, c + half, r) +
                               HeightAt(dem, c, r - half) + HeightAt(dem, c, r + half)) /
                                  4 +
                              jitter();
      }
    }
    amplitude = std::max<std::int64_t>(1, amplitude * roughness_percent / 200);
  }
  return MakeDem(n, n, [&dem](std::int32_t c, std::int32_t r) { return HeightAt(dem, c, r); });
}

Dem AnyLandscape(std::int32_t min_side, std::int32_t max_side, std::mt19937& random) {
  constexpr std::array<std::int32_t, 5> kReliefs{8, 60, 700, 9'000, 1 << 22};
  const std::int32_t columns = min_side + Below(max_side - min_side + 1, random);
  const std::int32_t rows = min_side + Below(max_side - min_side + 1, random);
  const std::int32_t relief = kReliefs[static_cast<std::size_t>(Below(5, random))];
  const Dem ground = FractalDem(std::max(columns, rows), relief, 60 + 10 * Below(8, random),
                                static_cast<std::uint32_t>(random()));
  const std::int32_t kind = Below(6, random);
  const std::int32_t step = 2 + Below(6, random);
  const std::int32_t slope = std::max(1, relief / (4 + Below(12, random)));
  const std::int32_t x = Below(columns, random);
  const std::int32_t y = Below(rows, random);
  return MakeDem(columns, rows, [&](std::int32_t c, std::int32_t r) -> std::int32_t {
    const std::int32_t h = HeightAt(ground, c, r);
    switch (kind) {
      case 0:  // ridges, folded up from below
        return std::abs(h - relief / 2);
      case 1:  // terraces
        return h / std::max(1, relief / (4 * step)) * 4;
      case 2:  // lakes of no data
        return h < relief / step ? kNoHeight : h;
      case 3:  // a coast: all that is low is flat
        return std::max(h, relief / 2);
      case 4:  // a cone with a rough surface
        return h / (8 * step) - slope * std::max(std::abs(c - x), std::abs(r - y)) / step;
      default:
        return h;
    }
  });
}

GridMap operator*(const GridMap& second, const GridMap& first) {
  return {second.xx * first.xx + second.xy * first.yx, second.xx * first.xy + second.xy * first.yy,
          second.yx * first.xx + second.yy * first.yx, second.yx * first.xy + second.yy * first.yy};
}

std::vector<GridMap> AllGridMaps() {
  std::vector<GridMap> maps;
  GridMap turn;
  for (int i = 0; i < 6; ++i) {
    maps.push_back(turn);
    maps.push_back(turn * kTranspose);
    turn = kTurnSixth * turn;
  }
  return maps;
}

MappedDem MapDem(const Dem& dem, const GridMap& map) {
  const auto x = [&map](std::int32_t c, std::int32_t r) { return map.xx * c + map.xy * r; };
  const auto y = [&map](std::int32_t c, std::int32_t r) { return map.yx * c + map.yy * r; };
  const std::int32_t c1 = dem.columns - 1;
  const std::int32_t r1 = dem.rows - 1;
  const auto [x_min, x_max] = std::minmax({0, x(c1, 0), x(0, r1), x(c1, r1)});
  const auto [y_min, y_max] = std::minmax({0, y(c1, 0), y(0, r1), y(c1, r1)});
  MappedDem mapped;
  mapped.dem = MakeDem(x_max - x_min + 1, y_max - y_min + 1,
                       [](std::int32_t, std::int32_t) { return kNoHeight; });
  for (VertexId v = 0; v < static_cast<VertexId>(dem.heights.size()); ++v) {
    const std::int32_t column = x(dem.Column(v), dem.Row(v)) - x_min;
    const std::int32_t row = y(dem.Column(v), dem.Row(v)) - y_min;
    HeightAt(mapped.dem, column, row) = dem.heights[static_cast<std::size_t>(v)];
    mapped.image.push_back(row * mapped.dem.columns + column);
  }
  return mapped;
}

Dem MapHeights(Dem dem, std::int32_t factor, std::int32_t offset) {
  for (std::int32_t& height : dem.heights) {
    if (height != kNoHeight) height = factor * height + offset;
  }
  return dem;
}

std::vector<Edge> MapEdges(const std::vector<Edge>& edges, const std::vector<VertexId>& image) {
  std::vector<Edge> mapped;
  for (const Edge edge : edges) {
    mapped.push_back(
        MakeEdge(image[static_cast<std::size_t>(edge.a)], image[static_cast<std::size_t>(edge.b)]));
  }
  std::sort(mapped.begin(), mapped.end());
  return mapped;
}

}  // namespace farhorizon
