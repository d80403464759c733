// FindHorizon on real DEMs, which are too large for the brute force: witnesses and random lines.

#include <filesystem>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "core/horizon/find_horizon.h"
#include "core/io/dem/read_dem.h"
#include "tests/support/effort.h"
#include "tests/support/matchers.h"

namespace farhorizon {
namespace {

// Every edge's witness holds, and no random line finds an edge that is left out.
void ExpectTheHorizon(const std::string& name, int lines) {
  const std::filesystem::path path = std::filesystem::path(FARHORIZON_DEM_DIR) / name;
  if (!std::filesystem::exists(path)) GTEST_SKIP() << "no " << name << " in FARHORIZON_DEM_DIR";
  Result<Dem> dem = ReadDem(path, {});
  ASSERT_TRUE(dem) << dem.error().message;
  const Terrain terrain = *Terrain::Build(*dem);
  const Horizon horizon = *FindHorizon(terrain, {.threads = 2}, {});
  std::vector<Edge> edges;
  for (const HorizonEdge& e : horizon.edges) {
    ASSERT_TRUE(WitnessHolds(terrain, e.edge, e.witness)) << e.edge.a << '-' << e.edge.b;
    edges.push_back(e.edge);
  }
  EXPECT_TRUE(MaximiserIsIn(terrain, edges, lines, 1));
}

class FindHorizonOnDem : public testing::TestWithParam<const char*> {};
TEST_P(FindHorizonOnDem, HasWitnessesThatHoldAndMissesNoLine) {
  ExpectTheHorizon(GetParam(), Rounds(300));
}
INSTANTIATE_TEST_SUITE_P(Small, FindHorizonOnDem,
                         testing::Values("gabilan_65.tif", "ontario_dted0_121.tif",
                                         "sthelens_crater_129.tif", "zion_257.tif"));

class FindHorizonOnDemLong : public testing::TestWithParam<const char*> {};
TEST_P(FindHorizonOnDemLong, HasWitnessesThatHoldAndMissesNoLine) {
  ExpectTheHorizon(GetParam(), Rounds(300));
}
INSTANTIATE_TEST_SUITE_P(Large, FindHorizonOnDemLong,
                         testing::Values("mandakini_alpine_257.tif", "sandiego_coast_512.tif",
                                         "presidential_srtm3_513.tif",
                                         "capetown_srtm3_nodata_sea.tif"));

}  // namespace
}  // namespace farhorizon
