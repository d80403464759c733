#include "core/geo/area_of_use.h"

#include <stdexcept>

#include <gtest/gtest.h>

#include "core/geo/parse_crs.h"

namespace farhorizon {
namespace {

AreaOfUse Of(const std::string& crs) {
  ProjSession session;
  Result<ProjObject> read = ParseCrs(session, crs);
  if (!read) throw std::runtime_error(read.error().message);
  std::optional<AreaOfUse> area = AreaOfUseOf(session, read->get());
  if (!area) throw std::runtime_error("no area");
  return *area;
}

TEST(AreaOfUse, IsThatOfTheSystemOrOfItsEquivalent) {
  EXPECT_TRUE(Of("EPSG:4326").IsWorld());
  EXPECT_FALSE(Of("EPSG:32613").IsWorld());
  EXPECT_EQ(Of("+proj=utm +zone=13 +datum=WGS84").west, Of("EPSG:32613").west);
  EXPECT_THROW(Of("+proj=tmerc +lon_0=-104 +datum=WGS84"), std::runtime_error);
}

TEST(AreaOfUse, MayCrossTheAntimeridian) {
  const AreaOfUse pacific{.west = 170, .south = -10, .east = -170, .north = 10};
  EXPECT_TRUE(pacific.Contains(175, 0));
  EXPECT_TRUE(pacific.Contains(-175, 0));
  EXPECT_FALSE(pacific.Contains(0, 0));
  EXPECT_FALSE(pacific.Contains(160, 0));
  EXPECT_TRUE(pacific.Widened(0.5).Contains(160, 15));
  EXPECT_FALSE(pacific.Widened(0.5).Contains(159, 0));
  EXPECT_FALSE(pacific.Widened(0.5).Contains(175, 21));
  const AreaOfUse zone_60{.west = 174, .south = -80, .east = 180, .north = 0};
  EXPECT_TRUE(zone_60.Widened(0.5).Contains(-178, -40));
  EXPECT_FALSE(zone_60.Widened(0.5).Contains(-176, -40));
}

TEST(AreaOfUse, WidenedBeyondAllIsTheWorld) {
  EXPECT_TRUE(
      AreaOfUse({.west = -100, .south = -60, .east = 100, .north = 60}).Widened(1).IsWorld());
}

}  // namespace
}  // namespace farhorizon
