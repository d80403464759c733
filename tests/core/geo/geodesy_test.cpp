// Runs tests/geodesy/*.txt: operation / tolerance / accept / expect, as PROJ's gie does.
#include <cmath>
#include <filesystem>
#include <fstream>
#include <sstream>

#include <gtest/gtest.h>

#include "core/geo/globe_transform.h"

namespace farhorizon {
namespace {

struct Triple {
  double x = 0;
  double y = 0;
  double z = 0;
};

struct Case {
  std::string where;  // file:line
  std::vector<std::string> operation;
  double plan_tolerance = 0;
  double height_tolerance = 0;
  Triple accept;
  Triple expect;
};

std::vector<Case> ReadCases(const std::filesystem::path& path) {
  std::ifstream in(path);
  if (!in) throw std::runtime_error("cannot read " + path.string());
  std::vector<Case> cases;
  Case current;
  std::string line;
  for (int number = 1; std::getline(in, line); ++number) {
    std::istringstream words(line);
    std::string verb;
    if (!(words >> verb) || verb[0] == '#') continue;
    const auto read = [&](Triple& t) { words >> t.x >> t.y >> t.z; };
    if (verb == "operation") {
      current.operation.clear();
      for (std::string word; words >> word;) current.operation.push_back(word);
      continue;
    }
    if (verb == "tolerance") {
      words >> current.plan_tolerance >> current.height_tolerance;
    } else if (verb == "accept") {
      read(current.accept);
    } else if (verb == "expect") {
      read(current.expect);
      current.where = path.filename().string() + ":" + std::to_string(number);
      cases.push_back(current);
    } else {
      throw std::runtime_error("unknown verb " + verb);
    }
    if (!words) throw std::runtime_error("bad line " + std::to_string(number));
  }
  return cases;
}

void ExpectNear(const Triple& found, const Triple& expected, const Case& c) {
  EXPECT_NEAR(found.x, expected.x, c.plan_tolerance) << c.where;
  EXPECT_NEAR(found.y, expected.y, c.plan_tolerance) << c.where;
  EXPECT_NEAR(found.z, expected.z, c.height_tolerance) << c.where;
}

// There and back: the inverse must give the accepted point itself.
void RunMap(const Case& c) {
  const std::string datum = c.operation.size() > 1 ? c.operation[1] : "";
  const MapPoint point = {c.accept.x, c.accept.y, c.accept.z};
  Result<GlobeTransform> globe =
      GlobeTransform::Open(c.operation[0], {.vertical_datum = datum, .about = point});
  ASSERT_TRUE(globe) << c.where << ": " << globe.error().message;
  Result<std::vector<Geodetic>> there = globe->ToGeodetic({point});
  ASSERT_TRUE(there) << c.where << ": " << there.error().message;
  const Geodetic g = there->front();
  ExpectNear({g.lon_deg, g.lat_deg, g.height_m}, c.expect, c);
  Result<std::vector<MapPoint>> back = globe->FromGeodetic(*there);
  ASSERT_TRUE(back) << c.where << ": " << back.error().message;
  EXPECT_NEAR(back->front().x, point.x, 1e-6) << c.where;
  EXPECT_NEAR(back->front().y, point.y, 1e-6) << c.where;
  EXPECT_NEAR(back->front().z, point.z, 1e-6) << c.where;
}

void RunEarthFixed(const Case& c) {
  Result<GlobeTransform> globe = GlobeTransform::Open("EPSG:4326");
  ASSERT_TRUE(globe);
  const Geodetic point = {c.accept.x, c.accept.y, c.accept.z};
  Result<std::vector<Ecef>> there = globe->ToEcef({point});
  ASSERT_TRUE(there);
  const Ecef p = there->front();
  if (c.operation[0] == "geocentric") {
    ExpectNear({p.x, p.y, p.z}, c.expect, c);
  } else {
    ASSERT_EQ(c.operation.size(), 4U) << c.where;
    const Geodetic origin = {std::stod(c.operation[1]), std::stod(c.operation[2]),
                             std::stod(c.operation[3])};
    Result<std::vector<Ecef>> centre = globe->ToEcef({origin});
    ASSERT_TRUE(centre);
    const TangentFrame frame(origin, centre->front());
    const Enu enu = frame.ToEnu(p);
    ExpectNear({enu.east, enu.north, enu.up}, c.expect, c);
  }
  Result<std::vector<Geodetic>> back = globe->FromEcef(*there);
  ASSERT_TRUE(back);
  EXPECT_NEAR(back->front().lon_deg, point.lon_deg, 1e-11) << c.where;
  EXPECT_NEAR(back->front().lat_deg, point.lat_deg, 1e-11) << c.where;
  EXPECT_NEAR(back->front().height_m, point.height_m, 1e-6) << c.where;
}

TEST(Geodesy, PublishedPointsComeOutAsPublished) {
  int run = 0;
  const std::filesystem::path folder =
      std::filesystem::path(FARHORIZON_SOURCE_DIR) / "tests/geodesy";
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    if (entry.path().extension() != ".txt") continue;
    for (const Case& c : ReadCases(entry.path())) {
      const bool earth_fixed = c.operation[0] == "geocentric" || c.operation[0] == "topocentric";
      earth_fixed ? RunEarthFixed(c) : RunMap(c);
      ++run;
    }
  }
  EXPECT_GE(run, 10) << "the files of " << folder << " are missing";
}

}  // namespace
}  // namespace farhorizon
