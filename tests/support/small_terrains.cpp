#include "tests/support/small_terrains.h"

#include <algorithm>
#include <array>

#include "core/terrain/terrain.h"
#include "tests/support/terrains.h"

namespace farhorizon {
namespace {

std::int32_t Below(std::int32_t bound, std::mt19937& random) {
  return static_cast<std::int32_t>(random() % static_cast<std::uint32_t>(bound));
}

Dem WithoutHoles(std::int32_t columns, std::int32_t rows, std::mt19937& random) {
  constexpr std::array<std::int32_t, 4> kReliefs{1, 3, 1000, 1 << 20};
  const std::int32_t relief = kReliefs[static_cast<std::size_t>(Below(4, random))];
  const std::int32_t x = Below(columns, random);
  const std::int32_t y = Below(rows, random);
  switch (Below(6, random)) {
    case 0:
      return MakeDem(columns, rows, [](std::int32_t, std::int32_t) { return 7; });
    case 1:
      return MakeDem(columns, rows,
                     [&](std::int32_t c, std::int32_t r) { return c < x || r < y ? 0 : relief; });
    case 2:
      return MakeDem(columns, rows, [&](std::int32_t, std::int32_t) {
        return Below(8, random) == 0 ? relief : 0;
      });
    case 3:
      return MakeDem(columns, rows, [&](std::int32_t c, std::int32_t r) { return 3 * c - 2 * r; });
    default:
      return MakeDem(columns, rows,
                     [&](std::int32_t, std::int32_t) { return Below(relief + 1, random); });
  }
}

}  // namespace

Dem AnySmallDem(std::int32_t most_side, std::mt19937& random) {
  for (;;) {
    std::int32_t columns = 2 + Below(most_side - 1, random);
    std::int32_t rows = 2 + Below(most_side - 1, random);
    switch (Below(8, random)) {
      case 0:
        columns = 2;
        break;
      case 1:
        rows = 2;
        break;
      case 2:
        columns = 2;
        rows = 2;
        break;
      default:
        break;
    }
    Dem dem;
    switch (columns > 2 && rows > 2 ? Below(3, random) : 2) {
      case 0:
        dem = AnyLandscape(3, most_side, random);
        break;
      case 1:
        dem = AnyRandomDem(3, most_side, random);
        break;
      default:
        dem = WithoutHoles(columns, rows, random);
        break;
    }
    const std::int32_t hole_percent = std::max(0, 10 * Below(6, random) - 20);
    for (std::int32_t& height : dem.heights) {
      if (Below(100, random) < hole_percent) height = kNoHeight;
    }
    if (Terrain::Build(dem)) return dem;
  }
}

Dem AnySmallDemInQuanta(std::int32_t most_side, std::mt19937& random) {
  constexpr std::array<double, 4> kQuanta{1.0, 0.01, 0.3048, 1.0 / 128};
  Dem dem = AnySmallDem(most_side, random);
  dem.quantum_m = kQuanta[static_cast<std::size_t>(Below(4, random))];
  dem.height_offset_m = Below(3, random) * 1234.5;
  return dem;
}

Dem AnySolidLandscape(std::int32_t min_side, std::int32_t max_side, std::mt19937& random) {
  for (;;) {
    Dem dem = AnyLandscape(min_side, max_side, random);
    if (Terrain::Build(dem)) return dem;
  }
}

}  // namespace farhorizon
