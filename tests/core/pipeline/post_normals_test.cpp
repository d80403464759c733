#include "core/pipeline/post_normals.h"

#include <algorithm>
#include <cmath>
#include <random>

#include <gtest/gtest.h>

#include "core/io/draco_mesh.h"

namespace farhorizon {
namespace {

constexpr double kCellM = 30;

// On UTM's central meridian, where grid north is north and the scale is within 0.04 % of 1.
template <typename Height>
Dem DemInCentimetres(std::int32_t columns, std::int32_t rows, Height height) {
  Dem dem;
  dem.columns = columns;
  dem.rows = rows;
  dem.quantum_m = 0.01;
  dem.transform = {500000, 5100000, kCellM, -kCellM};
  dem.crs = "EPSG:32610";
  for (std::int32_t r = 0; r < rows; ++r) {
    for (std::int32_t c = 0; c < columns; ++c) dem.heights.push_back(height(c, r));
  }
  return dem;
}

struct Placed {
  explicit Placed(Dem with)
      : dem(std::move(with)),
        terrain(*Terrain::Build(dem)),
        georeference(*Georeference::Of(terrain, {})) {
    for (VertexId v = 0; v < terrain.post_count(); ++v) {
      if (terrain.IsVertex(v)) vertices.push_back(v);
    }
  }
  Dem dem;
  Terrain terrain;
  Georeference georeference;
  std::vector<VertexId> vertices;
};

UnitNormal Widen(const std::array<float, 3>& n) { return {n[0], n[1], n[2]}; }

// The normals at some.vertices, in their order.
std::vector<UnitNormal> NormalsOf(const Placed& some) {
  Result<PostNormals> found = FindPostNormals(some.terrain, some.georeference);
  if (!found) throw std::runtime_error(found.error().message);
  std::vector<UnitNormal> normals;
  for (const VertexId v : some.vertices)
    normals.push_back(Widen(found->around[static_cast<std::size_t>(v)]));
  return normals;
}

double AngleDeg(const UnitNormal& a, const UnitNormal& b) {
  const double chord = std::hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]);
  return 2 * std::asin(chord / 2) * 180 / std::acos(-1.0);
}

// The normal of a surface that rises by `east` and `north`, metres per metre.
UnitNormal OfSlope(double east, double north) {
  const double length = std::hypot(east, north, 1);
  return {-east / length, -north / length, 1 / length};
}

TEST(PostNormals, OnASlopeAreItsNormalAtHolesAndBordersToo) {
  // 0.3 a metre eastwards, 0.5 southwards; holes leave strips, corners and single triangles.
  const Placed some(DemInCentimetres(40, 30, [](std::int32_t c, std::int32_t r) {
    return (c * 7 + r * 5) % 11 == 0 || (c * c + 3 * r) % 7 == 0 ? kNoHeight : 900 * c + 1500 * r;
  }));
  const std::vector<UnitNormal> normals = NormalsOf(some);
  ASSERT_EQ(normals.size(), some.vertices.size());
  for (const UnitNormal& n : normals) EXPECT_LT(AngleDeg(n, OfSlope(0.3, -0.5)), 0.05);
}

TEST(PostNormals, OnHillsAreThoseOfTheHills) {
  const auto height_m = [](double c, double r) {
    return 300 * std::sin(c / 9) + 200 * std::cos(r / 7 + c / 20);
  };
  const Placed some(DemInCentimetres(60, 50, [&](std::int32_t c, std::int32_t r) {
    return static_cast<std::int32_t>(std::lround(100 * height_m(c, r)));
  }));
  const std::vector<UnitNormal> normals = NormalsOf(some);
  for (std::int32_t r = 1; r < 49; ++r) {
    for (std::int32_t c = 1; c < 59; ++c) {
      const double east = 300.0 / 9 * std::cos(c / 9.0) - 200.0 / 20 * std::sin(r / 7.0 + c / 20.0);
      const double south = -200.0 / 7 * std::sin(r / 7.0 + c / 20.0);
      const VertexId v = r * 60 + c;
      const UnitNormal& n = normals[static_cast<std::size_t>(v)];
      EXPECT_LT(AngleDeg(n, OfSlope(east / kCellM, -south / kCellM)), 1) << c << " " << r;
    }
  }
}

TEST(PostNormals, AreTheMeanOfTheFacesByArea) {
  std::mt19937 random(3);
  const Placed some(DemInCentimetres(23, 19, [&](std::int32_t, std::int32_t) {
    return random() % 5 == 0 ? kNoHeight : static_cast<std::int32_t>(random() % 20000);
  }));
  // The slow twin adds every face's normal to its corners.
  std::vector<UnitNormal> sums(some.dem.heights.size(), {0, 0, 0});
  for (const Triangle& t : some.terrain.Triangles()) {
    const std::vector<Enu> p = *some.georeference.ToEnu(std::vector<VertexId>(t.begin(), t.end()));
    const UnitNormal u = {p[1].east - p[0].east, p[1].north - p[0].north, p[1].up - p[0].up};
    const UnitNormal v = {p[2].east - p[0].east, p[2].north - p[0].north, p[2].up - p[0].up};
    for (const VertexId corner : t) {
      for (std::size_t k = 0; k < 3; ++k) {
        sums[static_cast<std::size_t>(corner)][k] +=
            u[(k + 1) % 3] * v[(k + 2) % 3] - u[(k + 2) % 3] * v[(k + 1) % 3];
      }
    }
  }
  const std::vector<UnitNormal> normals = NormalsOf(some);
  for (std::size_t i = 0; i < normals.size(); ++i) {
    UnitNormal sum = sums[static_cast<std::size_t>(some.vertices[i])];
    const double length = std::hypot(sum[0], sum[1], sum[2]);
    for (double& x : sum) x /= length;
    EXPECT_LT(AngleDeg(normals[i], sum), 1e-4);
  }
}

TEST(PostNormals, PointUpwardsWhicheverWayTheRowsRun) {
  Dem dem =
      DemInCentimetres(9, 9, [](std::int32_t c, std::int32_t r) { return 900 * c + 1500 * r; });
  dem.transform.step_y = kCellM;  // the first row is the southernmost
  const Placed some(dem);
  for (const UnitNormal& n : NormalsOf(some)) {
    EXPECT_LT(AngleDeg(n, OfSlope(0.3, 0.5)), 0.05);
  }
}

TEST(PostNormals, OfCliffsAreRaisedToTheLeastThatEncodingTakes) {
  const Placed some(DemInCentimetres(12, 12, [](std::int32_t c, std::int32_t r) {
    return (c + r) % 3 == 0 ? 900000 : 7 * c - 5 * r;
  }));
  double least = 1;
  for (const UnitNormal& n : NormalsOf(some)) {
    EXPECT_NEAR(std::hypot(n[0], n[1], n[2]), 1, 1e-6);
    least = std::min(least, n[2]);
  }
  EXPECT_NEAR(least, kLeastNormalUp, 1e-4);  // the ellipsoid's normal tilts over the tile
}

TEST(PostNormals, AreZeroWhereThereIsNoTerrain) {
  const Placed some(DemInCentimetres(9, 9, [](std::int32_t c, std::int32_t r) {
    return c > 3 && (c + r) % 2 == 0 ? kNoHeight : 10 * c;
  }));
  const PostNormals normals = *FindPostNormals(some.terrain, some.georeference);
  ASSERT_EQ(normals.around.size(), 81U);
  for (VertexId v = 0; v < 81; ++v) {
    EXPECT_EQ(normals.around[static_cast<std::size_t>(v)][2] > 0, some.terrain.IsVertex(v)) << v;
  }
}

// Rolling hills, and a mesh over every `step`th post of them, with the terrain's diagonals.
Placed Hills(std::int32_t size) {
  return Placed(DemInCentimetres(size, size, [](std::int32_t c, std::int32_t r) {
    return static_cast<std::int32_t>(
        std::lround(9000 * std::sin(c / 6.0) * std::cos(r / 5.0) + 2500 * std::sin(c * r / 7.0)));
  }));
}

LocalMesh EveryNth(std::int32_t size, std::int32_t step) {
  LocalMesh mesh;
  const std::int32_t across = (size - 1) / step + 1;
  for (std::int32_t r = 0; r < across; ++r) {
    for (std::int32_t c = 0; c < across; ++c) {
      mesh.posts.push_back(static_cast<std::uint32_t>(r * step * size + c * step));
      mesh.positions.push_back({0, 0, 0});  // where up is does not matter to slopes
      if (r + 1 == across || c + 1 == across) continue;
      const auto nw = static_cast<std::uint32_t>(r * across + c);
      const auto down = static_cast<std::uint32_t>(across);
      mesh.triangles.push_back({nw, nw + down, nw + down + 1});
      mesh.triangles.push_back({nw, nw + down + 1, nw + 1});
    }
  }
  return mesh;
}

// The slow twin: tries every post of the terrain and returns the sums of the triangle's corners.
std::array<UnitNormal, 3> SumsOver(const Placed& some, const PostNormals& posts,
                                   const std::array<Point3i, 3>& p) {
  const auto area = [](Point3i a, Point3i b, Point3i c) {
    return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
  };
  const int whole = area(p[0], p[1], p[2]);
  std::array<UnitNormal, 3> sums{};
  for (VertexId v = 0; v < some.terrain.post_count(); ++v) {
    const Point3i q = some.terrain.Point(v);
    const std::array<int, 3> parts = {area(q, p[1], p[2]), area(p[0], q, p[2]),
                                      area(p[0], p[1], q)};
    if (std::ranges::any_of(parts, [&](int part) { return part * whole < 0; })) continue;
    const auto sides = std::ranges::count(parts, 0);
    const std::array<double, 3> here = {1, 1 / 2.0, 1 / 6.0};
    for (std::size_t corner = 0; corner < 3; ++corner) {
      const double share = static_cast<double>(parts[corner]) / whole;
      const double weight = here[static_cast<std::size_t>(sides)] * share * share;
      for (std::size_t k = 0; k < 3; ++k) {
        sums[corner][k] += weight * posts.around[static_cast<std::size_t>(v)][k];
      }
    }
  }
  return sums;
}

TEST(MeanNormals, WeighPostsByTheSquareOfTheirShare) {
  const Placed some = Hills(25);
  const PostNormals posts = *FindPostNormals(some.terrain, some.georeference);
  const LocalMesh mesh = EveryNth(25, 8);
  std::vector<UnitNormal> sums(mesh.posts.size(), {0, 0, 0});
  for (const auto& t : mesh.triangles) {
    std::array<Point3i, 3> p{};
    for (std::size_t k = 0; k < 3; ++k) {
      p[k] = some.terrain.Point(static_cast<VertexId>(mesh.posts[t[k]]));
    }
    const std::array<UnitNormal, 3> here = SumsOver(some, posts, p);
    for (std::size_t i = 0; i < 9; ++i) sums[t[i / 3]][i % 3] += here[i / 3][i % 3];
  }
  const std::vector<UnitNormal> normals =
      MeanNormals(some.terrain, some.georeference.frame(), posts, mesh);
  ASSERT_EQ(normals.size(), sums.size());
  for (std::size_t i = 0; i < sums.size(); ++i) {
    const double length = std::hypot(sums[i][0], sums[i][1], sums[i][2]);
    const UnitNormal mean = {sums[i][0] / length, sums[i][1] / length, sums[i][2] / length};
    EXPECT_LT(AngleDeg(normals[i], mean), 1e-4);
  }
}

TEST(MeanNormals, OnASlopeAreItsNormal) {
  const Placed some(
      DemInCentimetres(25, 25, [](std::int32_t c, std::int32_t r) { return 900 * c + 1500 * r; }));
  const PostNormals posts = *FindPostNormals(some.terrain, some.georeference);
  for (const UnitNormal& n :
       MeanNormals(some.terrain, some.georeference.frame(), posts, EveryNth(25, 6))) {
    EXPECT_LT(AngleDeg(n, OfSlope(0.3, -0.5)), 0.05);
  }
}

TEST(SeamReach, IsThatOfTheLevelWithinTheApron) {
  EXPECT_EQ(SeamReach(0, 3), 0);
  EXPECT_EQ(SeamReach(1, 3), 0);
  EXPECT_EQ(SeamReach(100, 0), 1);
  EXPECT_EQ(SeamReach(100, 1), 2);
  EXPECT_EQ(SeamReach(100, 4), 7);
  EXPECT_EQ(SeamReach(4, 4), 3);
}

TEST(MeanNormals, VerticesThatAreSplitBetweenFansGetTheNormalOfTheWhole) {
  const Placed some = Hills(25);
  const PostNormals posts = *FindPostNormals(some.terrain, some.georeference);
  const LocalMesh whole = EveryNth(25, 8);
  LocalMesh split = whole;
  for (auto& t : split.triangles) {
    for (std::uint32_t& v : t) {
      split.posts.push_back(split.posts[v]);
      split.positions.push_back(split.positions[v]);
      v = static_cast<std::uint32_t>(split.posts.size() - 1);
    }
  }
  const std::vector<UnitNormal> expected =
      MeanNormals(some.terrain, some.georeference.frame(), posts, whole);
  const std::vector<UnitNormal> normals =
      MeanNormals(some.terrain, some.georeference.frame(), posts, split);
  for (std::size_t t = 0; t < whole.triangles.size(); ++t) {
    for (std::size_t k = 0; k < 3; ++k) {
      EXPECT_EQ(normals[split.triangles[t][k]], expected[whole.triangles[t][k]]);
    }
  }
}

}  // namespace
}  // namespace farhorizon
