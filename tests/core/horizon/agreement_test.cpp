// The two engines, which share no algorithm, against each other where the brute force is too slow.
#include <algorithm>
#include <filesystem>
#include <random>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "core/io/dem/read_dem.h"
#include "tests/support/effort.h"
#include "tests/support/engines_agree.h"
#include "tests/support/terrains.h"

namespace farhorizon {
namespace {

// White noise is where the kinetic engine is slow: small grids of it only.
Dem AnyLargeDem(std::mt19937& random) {
  return random() % 5 == 0 ? AnyRandomDem(17, 25, random) : AnyLandscape(17, 65, random);
}

void ExpectAgreementOnRandomGrids(int rounds, std::uint32_t seed) {
  std::mt19937 random(seed);
  for (int round = 0; round < rounds; ++round) {
    ASSERT_TRUE(EnginesAgree(AnyLargeDem(random))) << "round " << round;
  }
}

TEST(Engines, AgreeOnRandomGridsOfUpTo65Posts) { ExpectAgreementOnRandomGrids(Rounds(40), 1); }

TEST(EnginesLong, AgreeOnHundredsOfRandomGridsOfUpTo65Posts) {
  ExpectAgreementOnRandomGrids(Rounds(500), 2);
}

// The posts of `dem` in the middle, side x side at most.
Dem Middle(const Dem& dem, std::int32_t side) {
  const std::int32_t columns = std::min(side, dem.columns);
  const std::int32_t rows = std::min(side, dem.rows);
  return MakeDem(columns, rows, [&](std::int32_t c, std::int32_t r) {
    const std::int32_t column = c + (dem.columns - columns) / 2;
    const std::int32_t row = r + (dem.rows - rows) / 2;
    const VertexId v = row * dem.columns + column;
    return dem.heights[static_cast<std::size_t>(v)];
  });
}

TEST(EnginesLong, AgreeOnEveryRealDemCutTo257Posts) {
  std::vector<std::filesystem::path> files;
  if (std::filesystem::is_directory(FARHORIZON_DEM_DIR)) {
    for (const auto& entry : std::filesystem::directory_iterator(FARHORIZON_DEM_DIR)) {
      const std::string ending = entry.path().extension();
      if (ending == ".tif" || ending == ".dt0") files.push_back(entry.path());
    }
  }
  if (files.empty()) GTEST_SKIP() << "no DEMs in FARHORIZON_DEM_DIR";
  std::sort(files.begin(), files.end());
  for (const std::filesystem::path& file : files) {
    Result<Dem> dem = ReadDem(file, {});
    ASSERT_TRUE(dem) << file << ' ' << dem.error().message;
    EXPECT_TRUE(EnginesAgree(Middle(*dem, 257))) << file;
  }
}

}  // namespace
}  // namespace farhorizon
