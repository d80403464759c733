#include "core/pipeline/post_normals.h"

#include <cmath>
#include <numeric>
#include <random>

#include <gtest/gtest.h>

namespace farhorizon {
namespace {

constexpr double kCellM = 30;

// On UTM's central meridian, where grid north is north and the scale is within 0.04 % of 1.
template <typename Height>
Dem MakeDem(std::int32_t columns, std::int32_t rows, Height height) {
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
        placement(*Placement::Of(terrain, "")) {
    for (VertexId v = 0; v < terrain.post_count(); ++v) {
      if (terrain.IsVertex(v)) vertices.push_back(v);
    }
  }
  Dem dem;
  Terrain terrain;
  Placement placement;
  std::vector<VertexId> vertices;
};

std::vector<UnitNormal> NormalsAt(const Placed& some, const std::vector<VertexId>& posts) {
  Result<std::vector<UnitNormal>> normals = PostNormals(some.terrain, some.placement, posts);
  if (!normals) throw std::runtime_error(normals.error().message);
  return *std::move(normals);
}

double AngleDeg(const UnitNormal& a, const UnitNormal& b) {
  const double chord = std::hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]);
  return 2 * std::asin(chord / 2) * 180 / std::acos(-1.0);
}

// Of a surface that rises by `east` and `north`, metres a metre.
UnitNormal OfSlope(double east, double north) {
  const double length = std::hypot(east, north, 1);
  return {-east / length, -north / length, 1 / length};
}

TEST(PostNormals, OnASlopeAreItsNormalAtHolesAndBordersToo) {
  // 0.3 a metre eastwards, 0.5 southwards; holes leave strips, corners and single triangles.
  const Placed some(MakeDem(40, 30, [](std::int32_t c, std::int32_t r) {
    return (c * 7 + r * 5) % 11 == 0 || (c * c + 3 * r) % 7 == 0 ? kNoHeight : 900 * c + 1500 * r;
  }));
  const std::vector<UnitNormal> normals = NormalsAt(some, some.vertices);
  ASSERT_EQ(normals.size(), some.vertices.size());
  for (const UnitNormal& n : normals) EXPECT_LT(AngleDeg(n, OfSlope(0.3, -0.5)), 0.05);
}

TEST(PostNormals, OnHillsAreThoseOfTheHills) {
  const auto height_m = [](double c, double r) {
    return 300 * std::sin(c / 9) + 200 * std::cos(r / 7 + c / 20);
  };
  const Placed some(MakeDem(60, 50, [&](std::int32_t c, std::int32_t r) {
    return static_cast<std::int32_t>(std::lround(100 * height_m(c, r)));
  }));
  for (std::int32_t r = 1; r < 49; ++r) {
    for (std::int32_t c = 1; c < 59; ++c) {
      const double east =
          (300.0 / 9 * std::cos(c / 9.0) - 200.0 / 20 * std::sin(r / 7.0 + c / 20.0));
      const double south = -200.0 / 7 * std::sin(r / 7.0 + c / 20.0);
      const UnitNormal n = NormalsAt(some, {r * 60 + c}).front();
      EXPECT_LT(AngleDeg(n, OfSlope(east / kCellM, -south / kCellM)), 1) << c << " " << r;
    }
  }
}

TEST(PostNormals, AreTheMeanOfTheFacesByArea) {
  std::mt19937 random(3);
  const Placed some(MakeDem(23, 19, [&](std::int32_t, std::int32_t) {
    return random() % 5 == 0 ? kNoHeight : static_cast<std::int32_t>(random() % 20000);
  }));
  // The slow twin: every face of the terrain hands its normal to its corners.
  std::vector<UnitNormal> sums(some.dem.heights.size(), {0, 0, 0});
  for (const Triangle& t : some.terrain.Triangles()) {
    const std::vector<Enu> p = *some.placement.ToEnu(std::vector<VertexId>(t.begin(), t.end()));
    const UnitNormal u = {p[1].east - p[0].east, p[1].north - p[0].north, p[1].up - p[0].up};
    const UnitNormal v = {p[2].east - p[0].east, p[2].north - p[0].north, p[2].up - p[0].up};
    for (const VertexId corner : t) {
      for (std::size_t k = 0; k < 3; ++k) {
        sums[static_cast<std::size_t>(corner)][k] +=
            u[(k + 1) % 3] * v[(k + 2) % 3] - u[(k + 2) % 3] * v[(k + 1) % 3];
      }
    }
  }
  const std::vector<UnitNormal> normals = NormalsAt(some, some.vertices);
  for (std::size_t i = 0; i < normals.size(); ++i) {
    UnitNormal sum = sums[static_cast<std::size_t>(some.vertices[i])];
    const double length = std::hypot(sum[0], sum[1], sum[2]);
    for (double& x : sum) x /= length;
    EXPECT_LT(AngleDeg(normals[i], sum), 1e-6);
  }
}

TEST(PostNormals, PointUpwardsWhicheverWayTheRowsRun) {
  Dem dem = MakeDem(9, 9, [](std::int32_t c, std::int32_t r) { return 900 * c + 1500 * r; });
  dem.transform.step_y = kCellM;  // the first row is the southernmost
  const Placed some(dem);
  for (const UnitNormal& n : NormalsAt(some, some.vertices)) {
    EXPECT_LT(AngleDeg(n, OfSlope(0.3, 0.5)), 0.05);
  }
}

TEST(PostNormals, OfCliffsAreRaisedToTheLeastThatEncodingTakes) {
  const Placed some(MakeDem(12, 12, [](std::int32_t c, std::int32_t r) {
    return (c + r) % 3 == 0 ? 900000 : 7 * c - 5 * r;
  }));
  double least = 1;
  for (const UnitNormal& n : NormalsAt(some, some.vertices)) {
    EXPECT_NEAR(std::hypot(n[0], n[1], n[2]), 1, 1e-12);
    least = std::min(least, n[2]);
  }
  EXPECT_EQ(least, kLeastNormalUp);
}

TEST(PostNormals, AreTheSameForSomePostsAsForAll) {
  // More posts than are placed at a time.
  const Placed some(MakeDem(300, 250, [](std::int32_t c, std::int32_t r) {
    return static_cast<std::int32_t>(3000 * std::sin(c / 5.0) + 2000 * std::cos(r / 3.0));
  }));
  const std::vector<UnitNormal> all = NormalsAt(some, some.vertices);
  std::vector<VertexId> few;
  for (VertexId v = some.terrain.post_count() - 1; v >= 0; v -= 137) few.push_back(v);
  few.push_back(few.front());
  const std::vector<UnitNormal> normals = NormalsAt(some, few);
  ASSERT_EQ(normals.size(), few.size());
  for (std::size_t i = 0; i < few.size(); ++i) {
    EXPECT_EQ(normals[i], all[static_cast<std::size_t>(few[i])]);
  }
}

}  // namespace
}  // namespace farhorizon
