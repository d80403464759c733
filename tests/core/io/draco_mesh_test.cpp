#include "core/io/draco_mesh.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <random>
#include <set>

#include <gtest/gtest.h>

#include "tests/support/local_meshes.h"

namespace farhorizon {
namespace {

LocalMesh RoundTrip(const LocalMesh& mesh, const QuantizationLattice& lattice) {
  Result<std::vector<std::uint8_t>> bytes = EncodeDraco(mesh, lattice);
  if (!bytes) throw std::runtime_error(bytes.error().message);
  Result<LocalMesh> decoded = DecodeDraco(*bytes);
  if (!decoded) throw std::runtime_error(decoded.error().message);
  return *decoded;
}

// The triangles by their vertices' sources, each turned so that its least source comes first.
std::multiset<std::array<std::uint32_t, 3>> BySource(const LocalMesh& mesh) {
  std::multiset<std::array<std::uint32_t, 3>> triangles;
  for (const auto& t : mesh.triangles) {
    std::array<std::uint32_t, 3> s = {mesh.sources[t[0]], mesh.sources[t[1]], mesh.sources[t[2]]};
    std::ranges::rotate(s, std::ranges::min_element(s));
    triangles.insert(s);
  }
  return triangles;
}

void ExpectSamePositions(const LocalMesh& decoded, const LocalMesh& mesh,
                         const QuantizationLattice& lattice) {
  std::map<std::uint32_t, Enu> by_source;
  for (std::size_t i = 0; i < mesh.sources.size(); ++i) {
    by_source[mesh.sources[i]] = SnapToLattice(mesh.positions[i], lattice);
  }
  for (std::size_t i = 0; i < decoded.sources.size(); ++i) {
    const auto found = by_source.find(decoded.sources[i]);
    ASSERT_NE(found, by_source.end());
    EXPECT_EQ(decoded.positions[i].east, found->second.east);
    EXPECT_EQ(decoded.positions[i].north, found->second.north);
    EXPECT_EQ(decoded.positions[i].up, found->second.up);
  }
}

TEST(ChooseLattice, StepIsThePowerOfTwoAtOrBelowTheWish) {
  const std::vector<Enu> points = {{-100, -50, 0}, {100, 50, 30}};
  EXPECT_EQ(ChooseLattice(points, 0.7).step_m, 0.5);
  EXPECT_EQ(ChooseLattice(points, 0.5).step_m, 0.5);
  EXPECT_EQ(ChooseLattice(points, 8.1).step_m, 8);
}

TEST(ChooseLattice, CoversItsPointsWithOriginsThatAreMultiplesOfTheStep) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> draw(-20000, 20000);
  for (int i = 0; i < 200; ++i) {
    std::vector<Enu> points;
    for (int k = 0; k < 5; ++k) points.push_back({draw(random), draw(random), draw(random) / 10});
    const QuantizationLattice lattice = ChooseLattice(points, std::abs(draw(random)) / 1000);
    EXPECT_LE(lattice.bits, 16);
    for (const double origin : lattice.origin) {
      EXPECT_EQ(std::remainder(origin, lattice.step_m), 0);
    }
    for (const Enu& p : points) {
      const Enu snapped = SnapToLattice(p, lattice);
      EXPECT_LE(std::abs(snapped.east - p.east), lattice.step_m / 2);
      EXPECT_LE(std::abs(snapped.north - p.north), lattice.step_m / 2);
      EXPECT_LE(std::abs(snapped.up - p.up), lattice.step_m / 2);
    }
  }
}

TEST(ChooseLattice, TakesNoMoreBitsThanCesiumReadsAndNoMoreThanItNeeds) {
  const std::vector<Enu> wide = {{0, 0, 0}, {30000, 0, 0}};
  EXPECT_EQ(ChooseLattice(wide, 0.001).bits, 16);
  EXPECT_EQ(ChooseLattice(wide, 0.001).step_m, 0.5);  // 60000 steps; a quarter would take 120000
  EXPECT_EQ(ChooseLattice({{0, 0, 0}, {7, 0, 0}}, 1).bits, 3);
  EXPECT_EQ(ChooseLattice({{5, 5, 5}}, 1).bits, 1);
}

TEST(ChooseLattice, FarFromTheOriginTheStepGrowsUntilFloatIsExact) {
  const QuantizationLattice lattice = ChooseLattice({{6e6, 0, 0}, {6e6 + 100, 0, 0}}, 1e-3);
  EXPECT_EQ(lattice.step_m, 0.5);  // 12e6 halves lie below 2^24, 24e6 quarters do not
}

TEST(Draco, DecodesToTheLatticeExactlyWithSourcesAndWindings) {
  const LocalMesh mesh = HillyGrid(61, 43, 27.3);
  for (const double wanted : {0.03, 0.5, 10.0}) {
    const QuantizationLattice lattice = ChooseLattice(mesh.positions, wanted);
    const LocalMesh decoded = RoundTrip(mesh, lattice);
    EXPECT_EQ(decoded.positions.size(), mesh.positions.size());
    EXPECT_EQ(BySource(decoded), BySource(mesh));
    ExpectSamePositions(decoded, mesh, lattice);
  }
}

TEST(Draco, AnyNumberBelowTheLimitIsCarriedAsSource) {
  LocalMesh mesh = HillyGrid(9, 9, 10);
  std::mt19937 random(17);
  for (std::uint32_t& source : mesh.sources) source = static_cast<std::uint32_t>(random()) >> 4U;
  mesh.sources[3] = 0;
  mesh.sources[4] = kMaxSource;
  const LocalMesh decoded = RoundTrip(mesh, ChooseLattice(mesh.positions, 0.1));
  EXPECT_EQ(BySource(decoded), BySource(mesh));
}

TEST(Draco, VerticesOfOnePlaceStayApart) {
  // Coarse enough that many neighbours fall on one lattice position: nothing is merged.
  const LocalMesh mesh = HillyGrid(30, 30, 1);
  const QuantizationLattice lattice = ChooseLattice(mesh.positions, 8);
  const LocalMesh decoded = RoundTrip(mesh, lattice);
  EXPECT_EQ(decoded.positions.size(), mesh.positions.size());
  EXPECT_EQ(BySource(decoded), BySource(mesh));
  ExpectSamePositions(decoded, mesh, lattice);
}

TEST(Draco, HolesAndVerticesBetweenFansSurvive) {
  // Holes that touch at corners leave vertices with two fans of triangles: they come back twice.
  const LocalMesh mesh = HillyGrid(24, 24, 10, [](std::uint32_t c, std::uint32_t r) {
    return (c * 7 + r * 5) % 11 == 0 || (c == 3 && r < 20);
  });
  const QuantizationLattice lattice = ChooseLattice(mesh.positions, 0.1);
  const LocalMesh decoded = RoundTrip(mesh, lattice);
  EXPECT_GE(decoded.positions.size(), mesh.positions.size());
  EXPECT_EQ(BySource(decoded), BySource(mesh));
  ExpectSamePositions(decoded, mesh, lattice);
}

TEST(Draco, SeveralPiecesAndASingleTriangleSurvive) {
  LocalMesh mesh = HillyGrid(20, 6, 10, [](std::uint32_t c, std::uint32_t) { return c % 4 == 3; });
  EXPECT_EQ(BySource(RoundTrip(mesh, ChooseLattice(mesh.positions, 0.1))), BySource(mesh));
  mesh = {.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}},
          .sources = {7, 8, 9},
          .triangles = {{0, 1, 2}}};
  EXPECT_EQ(BySource(RoundTrip(mesh, ChooseLattice(mesh.positions, 0.1))), BySource(mesh));
}

TEST(Draco, SameMeshSameBytes) {
  const LocalMesh mesh = HillyGrid(33, 33, 10);
  const QuantizationLattice lattice = ChooseLattice(mesh.positions, 0.1);
  EXPECT_EQ(*EncodeDraco(mesh, lattice), *EncodeDraco(mesh, lattice));
}

TEST(Draco, RefusesMeshesThatItWouldChange) {
  const LocalMesh good = HillyGrid(3, 3, 10);
  const QuantizationLattice lattice = ChooseLattice(good.positions, 0.1);
  const auto kind_of = [&](const LocalMesh& mesh) {
    Result<std::vector<std::uint8_t>> bytes = EncodeDraco(mesh, lattice);
    return bytes ? "encoded" : bytes.error().kind;
  };
  EXPECT_EQ(kind_of(good), "encoded");
  LocalMesh bad = good;
  bad.triangles.clear();
  EXPECT_EQ(kind_of(bad), "bad-mesh");
  bad = good;
  bad.triangles.push_back({0, 1, 1});
  EXPECT_EQ(kind_of(bad), "bad-mesh");
  bad = good;
  bad.triangles[0][0] = 99;
  EXPECT_EQ(kind_of(bad), "bad-mesh");
  bad = good;
  bad.sources[2] = kMaxSource + 1;
  EXPECT_EQ(kind_of(bad), "bad-mesh");
  bad = good;
  bad.positions.push_back({0, 0, 400});
  bad.sources.push_back(5);
  EXPECT_EQ(kind_of(bad), "bad-mesh");
}

TEST(Draco, APositionOutsideTheLatticeIsOurBug) {
  const LocalMesh mesh = HillyGrid(3, 3, 10);
  QuantizationLattice lattice = ChooseLattice(mesh.positions, 0.1);
  lattice.origin[0] += 100 * lattice.step_m;
  EXPECT_THROW(static_cast<void>(EncodeDraco(mesh, lattice)), InternalError);
}

TEST(DecodeDraco, RefusesWhatIsNoBitstream) {
  EXPECT_EQ(DecodeDraco({}).error().kind, "bad-draco");
  EXPECT_EQ(DecodeDraco({'D', 'R', 'A', 'C', 'O', 2, 2, 1, 1}).error().kind, "bad-draco");
  const LocalMesh mesh = HillyGrid(9, 9, 10);
  std::vector<std::uint8_t> bytes = *EncodeDraco(mesh, ChooseLattice(mesh.positions, 0.1));
  bytes.resize(bytes.size() / 2);
  EXPECT_EQ(DecodeDraco(bytes).error().kind, "bad-draco");
}

}  // namespace
}  // namespace farhorizon
