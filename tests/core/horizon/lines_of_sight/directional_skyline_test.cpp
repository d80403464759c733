#include "core/horizon/lines_of_sight/directional_skyline.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <random>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "core/horizon/find_horizon.h"
#include "core/io/dem/read_dem.h"
#include "tests/oracles/skyline_by_definition.h"
#include "tests/support/ascii_dem.h"
#include "tests/support/effort.h"
#include "tests/support/terrains.h"

namespace farhorizon {
namespace {

// A piece of the skyline as text: its edge by name and the ends of the piece, to a millionth.
std::string Told(Edge edge, double from, double to) {
  const auto share = [](double t) { return std::to_string(std::lround(t * 1e6)); };
  return std::to_string(edge.a) + '-' + std::to_string(edge.b) + ' ' + share(from) + ".." +
         share(to);
}

std::vector<std::string> Told(const Horizon& horizon, const std::vector<SkylinePiece>& skyline) {
  std::vector<std::string> told;
  for (const SkylinePiece& piece : skyline) {
    told.push_back(Told(horizon.edges[piece.edge].edge, piece.t_from, piece.t_to));
  }
  return told;
}

// The skyline of all edges of the terrain, by definition.
std::vector<std::string> TerrainSkyline(const Terrain& terrain, const ViewDirection& view) {
  const std::vector<Edge> edges = terrain.Edges();
  std::vector<Segment> segments;
  for (const Edge& e : edges) segments.push_back({terrain.Point(e.a), terrain.Point(e.b)});
  std::vector<std::string> told;
  for (const SeenStretch& stretch : SkylineByDefinition(segments, view)) {
    const Segment& s = segments[stretch.segment];
    const std::int64_t a = Offset(s.a, view);
    const std::int64_t run = Offset(s.b, view) - a;
    told.push_back(Told(edges[stretch.segment], static_cast<double>((stretch.from - a) / run),
                        static_cast<double>((stretch.to - a) / run)));
  }
  return told;
}

Dem AnyDemWithGround(std::int32_t max_side, std::mt19937& random) {
  for (;;) {
    Dem dem = AnyRandomDem(2, max_side, random);
    if (Terrain::Build(dem)) return dem;
  }
}

ViewDirection AnyView(std::mt19937& random) {
  // Steps of the grid, to which edges and faces are parallel, as often as others.
  const std::int32_t most = random() % 2 == 0 ? 1 : 9;
  for (;;) {
    const auto step = [&] {
      return static_cast<std::int32_t>(random() % (2 * static_cast<std::uint32_t>(most) + 1)) -
             most;
    };
    const ViewDirection view{step(), step()};
    if (view.dc != 0 || view.dr != 0) return view;
  }
}

TEST(DirectionalSkylines, AreTheEnvelopesOfAllEdgesOfTheTerrain) {
  std::mt19937 random(1);
  for (int round = 0; round < Rounds(1000); ++round) {
    const Dem dem = AnyDemWithGround(5, random);
    const Terrain terrain = *Terrain::Build(dem);
    const Horizon horizon = *FindHorizon(terrain, {}, {});
    const DirectionalSkylines skylines(terrain, horizon,
                                       *FindLinesOfSight(terrain, horizon, 1, {}));
    for (int i = 0; i < 3; ++i) {
      const ViewDirection view = AnyView(random);
      ASSERT_EQ(Told(horizon, skylines.Along(view)), TerrainSkyline(terrain, view))
          << DrawAscii(dem) << "along " << view.dc << ' ' << view.dr;
    }
  }
}

TEST(DirectionalSkylines, OfASupersetAreTheSame) {
  const Dem dem = FractalDem(33, 300, 100, 3);
  const Terrain terrain = *Terrain::Build(dem);
  const Horizon exact = *FindHorizon(terrain, {}, {});
  const Horizon more = *FindHorizon(
      terrain, {.work_budget = exact.statistics.predicates.Sum() / 3, .approximate = true}, {});
  ASSERT_GT(more.statistics.undecided, 0);
  const DirectionalSkylines of_exact(terrain, exact, *FindLinesOfSight(terrain, exact, 1, {}));
  const DirectionalSkylines of_more(terrain, more, *FindLinesOfSight(terrain, more, 1, {}));
  std::mt19937 random(4);
  for (int i = 0; i < 20; ++i) {
    const ViewDirection view = AnyView(random);
    EXPECT_EQ(Told(exact, of_exact.Along(view)), Told(more, of_more.Along(view)));
  }
}

// For terrains too large for the definition. Pieces that follow each other without a gap from one
// side of the view to the other, with lines of sight through them that meet nothing higher, are the
// skyline.
void ExpectTheSkyline(const Terrain& terrain, const Horizon& horizon,
                      const DirectionalSkylines& skylines, const ViewDirection& view) {
  const std::vector<SkylinePiece> skyline = skylines.Along(view);
  const auto offset = [&](const SkylinePiece& piece, double t) {
    const Edge edge = horizon.edges[piece.edge].edge;
    const auto a = static_cast<double>(Offset(terrain.Point(edge.a), view));
    const auto b = static_cast<double>(Offset(terrain.Point(edge.b), view));
    return a + t * (b - a);
  };
  const Dem& dem = terrain.dem();
  std::vector<std::int64_t> corners;
  for (const VertexId v :
       {0, dem.columns - 1, (dem.rows - 1) * dem.columns, dem.rows * dem.columns - 1}) {
    corners.push_back(Offset(terrain.Point(v), view));
  }
  const auto [least, most] = std::minmax_element(corners.begin(), corners.end());
  const double tolerance = 1e-9 * static_cast<double>(*most - *least);
  auto reached = static_cast<double>(*least);
  for (const SkylinePiece& piece : skyline) {
    ASSERT_NEAR(offset(piece, piece.t_from), reached, tolerance);
    reached = offset(piece, piece.t_to);
    const Witness middle{(piece.t_from + piece.t_to) / 2, view.dc, view.dr};
    ASSERT_TRUE(WitnessHolds(terrain, horizon.edges[piece.edge].edge, middle));
  }
  EXPECT_NEAR(reached, static_cast<double>(*most), tolerance);
}

TEST(DirectionalSkylines, LeaveNoGapAndMeetNothingHigherOnARealDem) {
  const std::filesystem::path path = std::filesystem::path(FARHORIZON_DEM_DIR) / "zion_257.tif";
  if (!std::filesystem::exists(path)) GTEST_SKIP() << "no zion_257.tif in FARHORIZON_DEM_DIR";
  const Dem dem = *ReadDem(path, {});
  const Terrain terrain = *Terrain::Build(dem);
  const Horizon horizon = *FindHorizon(terrain, {.threads = 2}, {});
  const DirectionalSkylines skylines(terrain, horizon, *FindLinesOfSight(terrain, horizon, 2, {}));
  std::mt19937 random(5);
  for (int i = 0; i < Rounds(40); ++i) {
    const auto step = [&] {
      return static_cast<std::int32_t>(random() % (2UL * kMaxViewStep)) - kMaxViewStep;
    };
    ExpectTheSkyline(terrain, horizon, skylines,
                     i % 4 == 0 ? AnyView(random) : ViewDirection{step(), step()});
  }
}

}  // namespace
}  // namespace farhorizon
