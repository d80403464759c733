#include "core/io/edge_visibility.h"

#include <cmath>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/support/local_meshes.h"

namespace farhorizon {
namespace {

using ::testing::ElementsAre;

// The extension's own example, indices 0,1,2, 0,2,3:
//   0______3
//   | \    |
//   |____\ |
//   1      2
LocalMesh Square() {
  return {.positions = {{0, 1, 0}, {0, 0, 0}, {1, 0, 0}, {1, 1, 0}},
          .posts = {0, 1, 2, 3},
          .normals = {{0, 0, 1}, {0, 0, 1}, {0, 0, 1}, {0, 0, 1}},
          .triangles = {{0, 1, 2}, {0, 2, 3}}};
}

std::vector<int> Values(const EdgeVisibility& edges, std::size_t triangles) {
  std::vector<int> values;
  for (std::size_t i = 0; i < 3 * triangles; ++i) {
    values.push_back((edges.bits[i / 4] >> (2 * (i % 4))) & 3);
  }
  return values;
}

TEST(FlagEdges, ASharedEdgeIsASilhouetteOnceAndABorderEdgeIsHard) {
  const EdgeVisibility edges = FlagEdges(Square(), {{2, 0}, {0, 1}});
  EXPECT_THAT(Values(edges, 2), ElementsAre(2, 0, 1, 0, 0, 0));
  EXPECT_THAT(edges.bits, ElementsAre(18, 0));
  EXPECT_EQ(edges.edge_count, 2);
  EXPECT_THAT(edges.normals, ElementsAre(0, 0, 127, 0, 0, 127));
}

TEST(FlagEdges, UnusedBitsAreZeroAndThereIsAByteForEveryFourEdges) {
  const EdgeVisibility edges = FlagEdges(Square(), {{3, 0}});
  EXPECT_THAT(edges.bits, ElementsAre(0, 2 << 2));
  EXPECT_TRUE(edges.normals.empty());
}

TEST(FlagEdges, PairsThatAreNoEdgeAreLeftOut) {
  EXPECT_EQ(FlagEdges(Square(), {{1, 3}}).edge_count, 0);
  EXPECT_EQ(FlagEdges(Square(), {}).edge_count, 0);
}

TEST(FlagEdges, VerticesThatDracoSplitCountAsOne) {
  LocalMesh mesh = Square();
  mesh.positions.push_back(mesh.positions[2]);
  mesh.posts.push_back(2);
  mesh.triangles[1] = {0, 4, 3};
  const EdgeVisibility edges = FlagEdges(mesh, {{0, 2}, {0, 4}});
  EXPECT_THAT(Values(edges, 2), ElementsAre(0, 0, 1, 0, 0, 0));
  EXPECT_EQ(edges.edge_count, 1);
}

TEST(FlagEdges, VerticesOfOneSourceButOtherHeightStayApart) {
  LocalMesh mesh = Square();  // as at a skirt, whose lower vertices stand for the same posts
  mesh.positions.push_back({0, 1, -9});
  mesh.posts.push_back(0);
  mesh.triangles.push_back({0, 4, 1});
  EXPECT_EQ(FlagEdges(mesh, {{4, 1}}).edge_count, 1);
  EXPECT_THAT(Values(FlagEdges(mesh, {{4, 1}}), 3), ElementsAre(0, 0, 0, 0, 0, 0, 0, 2, 0));
}

TEST(FlagEdges, NormalsComeInTheOrderOfTheFlagsAndPointOutOfTheGround) {
  const LocalMesh mesh = HillyGrid(12, 9, 10);
  std::vector<std::pair<std::uint32_t, std::uint32_t>> all;
  for (const auto& t : mesh.triangles) {
    for (std::size_t k = 0; k < 3; ++k) all.emplace_back(t[k], t[(k + 1) % 3]);
  }
  const EdgeVisibility edges = FlagEdges(mesh, all);
  const std::int64_t border = 2 * (11 + 8);
  const std::int64_t total = (12 * 9) + static_cast<std::int64_t>(mesh.triangles.size()) - 1;
  EXPECT_EQ(edges.edge_count, total);  // Euler: V - E + F = 1
  EXPECT_EQ(edges.normals.size(), static_cast<std::size_t>(6 * (total - border)));
  for (std::size_t i = 0; i < edges.normals.size(); i += 3) {
    EXPECT_GT(edges.normals[i + 2], 0);
    EXPECT_NEAR(std::hypot(edges.normals[i], edges.normals[i + 1], edges.normals[i + 2]), 127, 1.5);
  }
}

// A strip of 2 n triangles, all of whose edges are flagged.
EdgeVisibility AllOfAStrip(std::uint32_t n, LocalMesh& mesh) {
  mesh = {};
  std::vector<std::pair<std::uint32_t, std::uint32_t>> all;
  for (std::uint32_t i = 0; i < 2 * n + 2; ++i) {
    mesh.positions.push_back({static_cast<double>(i / 2), static_cast<double>(i % 2), i * i * 0.1});
    mesh.posts.push_back(i);
    for (std::uint32_t j = i + 1; j <= i + 3; ++j) {
      if (j < 2 * n + 2) all.emplace_back(i, j);
    }
  }
  for (std::uint32_t i = 0; i < 2 * n; i += 2) {
    mesh.triangles.push_back({i, i + 2, i + 3});
    mesh.triangles.push_back({i, i + 3, i + 1});
  }
  return FlagEdges(mesh, all);
}

TEST(SplitEdges, PartsSayWhatTheWholeSaysAndJoinToIt) {
  LocalMesh mesh;
  const EdgeVisibility whole = AllOfAStrip(9, mesh);
  const std::vector<std::size_t> counts = {1, 0, 4, 5, 2, 6};
  const std::vector<EdgeVisibility> parts = SplitEdges(whole, counts);
  ASSERT_EQ(parts.size(), counts.size());
  std::vector<int> values;
  std::vector<std::int8_t> normals;
  for (std::size_t i = 0; i < parts.size(); ++i) {
    for (const int value : Values(parts[i], counts[i])) values.push_back(value);
    normals.insert(normals.end(), parts[i].normals.begin(), parts[i].normals.end());
  }
  EXPECT_EQ(values, Values(whole, 18));
  EXPECT_EQ(normals, whole.normals);
  EXPECT_EQ(JoinEdges(parts, counts), whole);
}

TEST(JoinEdges, PartsWithBitsOrNormalsForOtherTrianglesAreRefused) {
  LocalMesh mesh;
  const EdgeVisibility whole = AllOfAStrip(3, mesh);
  EXPECT_EQ(JoinEdges({whole}, {6}), whole);
  EXPECT_FALSE(JoinEdges({whole}, {7}));
  EdgeVisibility odd = whole;
  odd.normals.push_back(0);
  EXPECT_FALSE(JoinEdges({odd}, {6}));
  odd.normals.resize(6);
  EXPECT_FALSE(JoinEdges({odd}, {6}));
  odd = whole;
  odd.bits.back() = static_cast<std::uint8_t>(odd.bits.back() | 0x80U);  // of no side
  EXPECT_FALSE(JoinEdges({odd}, {6}));
  EXPECT_EQ(JoinEdges({{}, {}}, {3, 3})->edge_count, 0);
}

}  // namespace
}  // namespace farhorizon
