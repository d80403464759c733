#include "core/io/skyline_features.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "tests/support/published.h"

namespace farhorizon {
namespace {

using nlohmann::json;

TEST(SkylineGeoJson, SaysEachPartOnceAndItsEndsWithoutLoss) {
  const json skyline = json::parse(WriteSkylineGeoJson(SomeSkyline()));
  EXPECT_EQ(skyline["azimuth"], 30);
  EXPECT_EQ(skyline["direction"], json::parse("[4194304,-77]"));
  EXPECT_FALSE(skyline.contains("approximate"));
  ASSERT_EQ(skyline["features"].size(), 3U);
  const json& part = skyline["features"][1];
  EXPECT_EQ(part["geometry"]["coordinates"], json::parse("[[7,46,480],[7.5,46,490]]"));
  EXPECT_EQ(part["properties"]["t"][1].get<double>(), 2.0 / 3);
  EXPECT_EQ(part["properties"]["offset_m"], json::parse("[-50,0]"));
}

TEST(SkylineGeoJson, OfASupersetSaysSo) {
  SkylineOfDirection skyline = SomeSkyline();
  skyline.approximate = true;
  EXPECT_EQ(json::parse(WriteSkylineGeoJson(skyline))["approximate"], true);
}

}  // namespace
}  // namespace farhorizon
