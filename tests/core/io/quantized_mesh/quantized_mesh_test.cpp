#include "core/io/quantized_mesh/quantized_mesh.h"

#include <cmath>
#include <set>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/geo/ellipsoid.h"
#include "tests/support/terrain_tile.h"

namespace farhorizon {
namespace {

using ::testing::ElementsAre;
using ::testing::UnorderedElementsAreArray;

// `cells` x `cells` squares over a tile, with hills; vertices row by row from the south.
QuantizedTile Hills(int cells) {
  QuantizedTile tile{{7.5, 45, 7.6, 45.1}, {-20, 1000}, {}, {}};
  for (int r = 0; r <= cells; ++r) {
    for (int c = 0; c <= cells; ++c) {
      const double angle = 0.3 * std::sin(c + 2.0 * r);
      tile.vertices.push_back(
          {static_cast<std::uint16_t>(c * kMostQuantized / cells),
           static_cast<std::uint16_t>(r * kMostQuantized / cells),
           static_cast<std::uint16_t>((c * 7919 + r * 104729) % (kMostQuantized + 1)),
           {static_cast<float>(std::sin(angle)), 0, static_cast<float>(-std::cos(angle))}});
    }
  }
  const auto at = [cells](int c, int r) { return static_cast<std::uint32_t>(r * (cells + 1) + c); };
  // From the north on, so that vertices are not used in the order of their numbers.
  for (int r = cells - 1; r >= 0; --r) {
    for (int c = 0; c < cells; ++c) {
      tile.triangles.push_back({at(c, r), at(c + 1, r), at(c + 1, r + 1)});
      tile.triangles.push_back({at(c, r), at(c + 1, r + 1), at(c, r + 1)});
    }
  }
  return tile;
}

using Corner = std::array<int, 3>;
using Corners = std::array<Corner, 3>;

std::vector<Corners> CornersOf(const QuantizedTile& tile) {
  std::vector<Corners> all;
  for (const auto& t : tile.triangles) {
    Corners corners;
    for (std::size_t k = 0; k < 3; ++k) {
      const QuantizedVertex& v = tile.vertices[t[k]];
      corners[k] = {v.u, v.v, v.height};
    }
    all.push_back(corners);
  }
  return all;
}

std::vector<Corners> CornersOf(const TerrainTile& tile) {
  std::vector<Corners> all;
  for (const auto& t : tile.triangles) {
    all.push_back({tile.vertices[t[0]], tile.vertices[t[1]], tile.vertices[t[2]]});
  }
  return all;
}

TEST(QuantizedMesh, ReadsBackAsItWas) {
  const QuantizedTile tile = Hills(5);
  const TerrainTile read = ReadTerrainTile(EncodeQuantizedMesh(tile, R"({"geometricerror":2.5})"));
  EXPECT_EQ(CornersOf(read), CornersOf(tile));
  EXPECT_EQ(read.heights_m, tile.heights_m);
  EXPECT_EQ(read.metadata["geometricerror"], 2.5);
  EXPECT_EQ(read.index_bytes, 2);
}

TEST(QuantizedMesh, ListsEachVertexOfASideRoundTheTile) {
  const TerrainTile read = ReadTerrainTile(EncodeQuantizedMesh(Hills(3), "{}"));
  const auto places = [&read](std::size_t side) {
    std::vector<std::array<int, 2>> at;
    for (const std::uint32_t v : read.sides[side]) {
      at.push_back({read.vertices[v][0], read.vertices[v][1]});
    }
    return at;
  };
  using Place = std::array<int, 2>;
  constexpr int kThird = 10922;
  constexpr int kEnd = 32767;
  EXPECT_THAT(places(0),
              ElementsAre(Place{0, 0}, Place{0, kThird}, Place{0, 21844}, Place{0, kEnd}));
  EXPECT_THAT(places(1),
              ElementsAre(Place{kEnd, 0}, Place{21844, 0}, Place{kThird, 0}, Place{0, 0}));
  EXPECT_EQ(places(2).front(), (Place{kEnd, kEnd}));
  EXPECT_EQ(places(3).front(), (Place{0, kEnd}));
  EXPECT_EQ(read.sides[2].size(), 4U);
  EXPECT_EQ(read.sides[3].size(), 4U);
}

TEST(QuantizedMesh, NormalsAreWithinADegree) {
  const QuantizedTile tile = Hills(5);
  const TerrainTile read = ReadTerrainTile(EncodeQuantizedMesh(tile, "{}"));
  for (std::size_t i = 0; i < read.vertices.size(); ++i) {
    // Places differ, so that one finds the vertex again.
    const auto same = std::find_if(tile.vertices.begin(), tile.vertices.end(), [&](const auto& v) {
      return v.u == read.vertices[i][0] && v.v == read.vertices[i][1];
    });
    double dot = 0;
    for (std::size_t k = 0; k < 3; ++k) dot += read.normals[i][k] * double{same->normal[k]};
    EXPECT_GT(dot, std::cos(std::numbers::pi / 180));
  }
}

TEST(QuantizedMesh, TheSphereHoldsEachVertexAsAClientPlacesIt) {
  const QuantizedTile tile = Hills(8);
  const TerrainTile read = ReadTerrainTile(EncodeQuantizedMesh(tile, "{}"));
  double furthest = 0;
  for (const QuantizedVertex& v : tile.vertices) {
    const Ecef p = EcefOf(PlaceOf(tile, v));
    furthest = std::max(furthest,
                        std::hypot(p.x - read.sphere.x, p.y - read.sphere.y, p.z - read.sphere.z));
  }
  EXPECT_NEAR(furthest, read.sphere_m, 1e-6);
  EXPECT_GT(std::hypot(read.occlusion.x, read.occlusion.y, read.occlusion.z), 1);
}

TEST(QuantizedMesh, MoreThan65536VerticesTakeWideIndicesOnAMultipleOfFour) {
  const QuantizedTile tile = Hills(256);  // 257 x 257 vertices, an odd number
  const TerrainTile read = ReadTerrainTile(EncodeQuantizedMesh(tile, "{}"));
  EXPECT_EQ(read.index_bytes, 4);
  EXPECT_EQ(CornersOf(read), CornersOf(tile));
}

TEST(QuantizedMesh, AsManyAs65536TakeShortOnes) {
  const QuantizedTile tile = Hills(255);
  ASSERT_EQ(tile.vertices.size(), 65536U);
  const TerrainTile read = ReadTerrainTile(EncodeQuantizedMesh(tile, "{}"));
  EXPECT_EQ(read.index_bytes, 2);
  EXPECT_EQ(CornersOf(read), CornersOf(tile));
}

TEST(QuantizedMesh, AHemisphereHasNoHorizonOcclusionPoint) {
  QuantizedTile tile = Hills(32);
  tile.rectangle = {-180, -90, 0, 90};
  tile.heights_m = {0, 0};
  EXPECT_TRUE(std::isnan(ReadTerrainTile(EncodeQuantizedMesh(tile, "{}")).occlusion.x));
}

}  // namespace
}  // namespace farhorizon
