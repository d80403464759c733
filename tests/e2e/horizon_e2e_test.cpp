// `farhorizon horizon` as it is typed: the program itself, its files, its exit status and what it
// says.
#include <filesystem>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "tests/support/hilly_grid.h"
#include "tests/support/json_schema.h"
#include "tests/support/service_process.h"
#include "tests/support/temp_dir.h"

namespace farhorizon {
namespace {

using nlohmann::json;
using testing::HasSubstr;

class HorizonE2e : public testing::Test {
 protected:
  void SetUp() override { SpillFile(folder_ / "hills.asc", HillyGrid(40, 30)); }

  /// The exit status of `farhorizon horizon hills.asc -o FILE` with all that a text grid leaves
  /// open, and what is added.
  int Run(const std::string& file, const std::vector<std::string>& added) {
    std::vector<std::string> words = {FARHORIZON_PROGRAM,
                                      "horizon",
                                      (folder_ / "hills.asc").string(),
                                      "-o",
                                      (folder_ / file).string(),
                                      "--crs",
                                      "EPSG:4326",
                                      "--vertical-datum",
                                      "ellipsoid",
                                      "--height-unit",
                                      "m"};
    words.insert(words.end(), added.begin(), added.end());
    return Process(words, {}, folder_ / "stderr").Wait(std::chrono::seconds(300));
  }
  std::string Said() { return SlurpFile(folder_ / "stderr"); }

  std::set<std::pair<json, json>> EdgesIn(const std::string& file) {
    std::set<std::pair<json, json>> edges;
    const json collection = json::parse(SlurpFile(folder_ / file));
    for (const json& feature : collection["features"]) {
      edges.emplace(feature["properties"]["a"], feature["properties"]["b"]);
    }
    return edges;
  }

  TempDir folder_;
};

TEST_F(HorizonE2e, EveryEngineFindsTheSameEdges) {
  for (const char* engine : {"adaptive", "kinetic", "auto"}) {
    ASSERT_EQ(Run(std::string(engine) + ".geojson", {"--engine", engine}), 0) << Said();
    EXPECT_EQ(Said(), "") << "nothing to say on a pipe";
  }
  ASSERT_EQ(Run("unsaid.geojson", {}), 0) << Said();
  const auto edges = EdgesIn("adaptive.geojson");
  EXPECT_GT(edges.size(), 100U);
  EXPECT_EQ(EdgesIn("kinetic.geojson"), edges);
  ASSERT_EQ(Run("bgh.geojson", {"--engine", "kinetic", "--kinetic-hull", "bgh"}), 0) << Said();
  EXPECT_EQ(EdgesIn("bgh.geojson"), edges);
  EXPECT_EQ(SlurpFile(folder_ / "auto.geojson"), SlurpFile(folder_ / "adaptive.geojson"));
  EXPECT_EQ(SlurpFile(folder_ / "unsaid.geojson"), SlurpFile(folder_ / "auto.geojson"));
  const json shape = json::parse(
      SlurpFile(std::string(FARHORIZON_SOURCE_DIR) + "/proto/schemas/horizon.schema.json"));
  for (const char* file : {"adaptive.geojson", "kinetic.geojson"}) {
    EXPECT_THAT(SchemaOffences(json::parse(SlurpFile(folder_ / file)), shape), testing::IsEmpty());
  }
}

TEST_F(HorizonE2e, EveryEngineWritesTheSameBytesForAnyNumberOfThreads) {
  for (const char* engine : {"adaptive", "kinetic"}) {
    ASSERT_EQ(Run("one.geojson", {"--engine", engine, "--threads", "1"}), 0) << Said();
    ASSERT_EQ(Run("three.geojson", {"--engine", engine, "--threads", "3"}), 0) << Said();
    EXPECT_EQ(SlurpFile(folder_ / "one.geojson"), SlurpFile(folder_ / "three.geojson")) << engine;
  }
}

TEST_F(HorizonE2e, AnUnknownEngineIsRefusedByNameWithThoseThatThereAre) {
  EXPECT_EQ(Run("edges.geojson", {"--engine", "steam"}), 2);
  EXPECT_THAT(Said(), HasSubstr("--engine"));
  EXPECT_THAT(Said(), HasSubstr("steam"));
  for (const char* engine : {"adaptive", "kinetic", "auto"}) {
    EXPECT_THAT(Said(), HasSubstr(engine));
  }
  EXPECT_EQ(Run("edges.geojson", {"--engine"}), 2);
  EXPECT_THAT(Said(), HasSubstr("--engine"));
  EXPECT_FALSE(std::filesystem::exists(folder_ / "edges.geojson"));
}

TEST_F(HorizonE2e, AnUnknownEndingIsRefusedBeforeAnyWork) {
  EXPECT_EQ(Run("edges.txt", {"--engine", "kinetic"}), 2);
  EXPECT_THAT(Said(), HasSubstr(".geojson, .fgb or .gpkg"));
}

TEST_F(HorizonE2e, EndsPastTheWorkBudgetAndNamesTheRemedy) {
  EXPECT_EQ(Run("edges.geojson", {"--work-budget", "1000"}), 1);
  EXPECT_THAT(Said(), HasSubstr("work budget of 1000"));
  EXPECT_THAT(Said(), HasSubstr("approximate"));
  EXPECT_FALSE(std::filesystem::exists(folder_ / "edges.geojson"));
  EXPECT_EQ(Run("edges.geojson", {"--engine", "kinetic", "--work-budget", "100"}), 1);
  EXPECT_THAT(Said(), HasSubstr("take the adaptive engine"));
  EXPECT_EQ(Run("edges.geojson", {"--work-budget", "0"}), 2);
  EXPECT_THAT(Said(), HasSubstr("--work-budget"));
}

TEST_F(HorizonE2e, WritesAMarkedSupersetWhereItMayBeApproximate) {
  ASSERT_EQ(Run("exact.geojson", {"--approximate"}), 0) << Said();
  EXPECT_EQ(Said(), "");
  ASSERT_EQ(Run("some.geojson", {"--work-budget", "3000", "--approximate"}), 0) << Said();
  const json exact = json::parse(SlurpFile(folder_ / "exact.geojson"));
  EXPECT_FALSE(exact.contains("approximate")) << "a budget that suffices leaves no doubt";
  const json some = json::parse(SlurpFile(folder_ / "some.geojson"));
  EXPECT_EQ(some["approximate"], true);
  int undecided = 0;
  for (const json& feature : some["features"]) {
    undecided += feature["properties"].contains("undecided") ? 1 : 0;
  }
  EXPECT_GT(undecided, 0);
  EXPECT_EQ(some["undecided"], undecided);
  EXPECT_THAT(Said(), HasSubstr("leaves " + std::to_string(undecided) + " of " +
                                std::to_string(some["features"].size()) + " edges undecided"));
  const auto kept = EdgesIn("some.geojson");
  for (const auto& edge : EdgesIn("exact.geojson")) EXPECT_EQ(kept.count(edge), 1U);
  const json shape = json::parse(
      SlurpFile(std::string(FARHORIZON_SOURCE_DIR) + "/proto/schemas/horizon.schema.json"));
  EXPECT_THAT(SchemaOffences(some, shape), testing::IsEmpty());
}

TEST_F(HorizonE2e, SaysOfEdgesWhatItIsAskedFor) {
  ASSERT_EQ(Run("none.geojson", {"--weights", "none"}), 0) << Said();
  ASSERT_EQ(Run("fast.geojson", {"--weights", "fast"}), 0) << Said();
  ASSERT_EQ(Run("full.geojson", {"--weights", "full"}), 0) << Said();
  ASSERT_EQ(Run("unsaid.geojson", {}), 0) << Said();
  EXPECT_EQ(SlurpFile(folder_ / "unsaid.geojson"), SlurpFile(folder_ / "full.geojson"));
  const json none = json::parse(SlurpFile(folder_ / "none.geojson"))["features"];
  const json fast = json::parse(SlurpFile(folder_ / "fast.geojson"))["features"];
  json full = json::parse(SlurpFile(folder_ / "full.geojson"))["features"];
  ASSERT_GT(full.size(), 100U);
  for (json& feature : full) feature["properties"].erase("skyline_drop_m");
  EXPECT_EQ(fast, full);
  for (json& feature : full) {
    for (const char* name : {"azimuths", "spans", "angular_share", "line_measure_m"}) {
      EXPECT_EQ(feature["properties"].erase(name), 1U);
    }
  }
  EXPECT_EQ(none, full);
  EXPECT_EQ(Run("edges.geojson", {"--weights", "some"}), 2);
  EXPECT_THAT(Said(), HasSubstr("--weights"));
}

TEST_F(HorizonE2e, WritesItsTimesWhereAskedTo) {
  ASSERT_EQ(Run("plain.geojson", {}), 0) << Said();
  const std::string file = (folder_ / "times.json").string();
  ASSERT_EQ(Run("timed.geojson", {"--timings", file}), 0) << Said();
  EXPECT_EQ(SlurpFile(folder_ / "timed.geojson"), SlurpFile(folder_ / "plain.geojson"));
  const json times = json::parse(SlurpFile(file));
  for (const char* stage :
       {"read", "sweep", "candidates", "decide", "lines-of-sight", "edge-measures", "write"}) {
    EXPECT_GE(times.at(stage).get<double>(), 0) << stage;
  }
  EXPECT_EQ(Run("timed.geojson", {"--timings", (folder_ / "no" / "times.json").string()}), 1);
  EXPECT_THAT(Said(), HasSubstr("cannot write the timings"));
}

// The set takes less than this budget, all that is said of it more.
TEST_F(HorizonE2e, SaysWhatItCouldNotAffordOfEachEdge) {
  const std::vector<std::string> short_of = {"--work-budget", "400000", "--approximate"};
  EXPECT_EQ(Run("edges.geojson", {"--work-budget", "400000"}), 1);
  EXPECT_THAT(Said(), HasSubstr("work budget of 400000"));
  ASSERT_EQ(Run("some.geojson", short_of), 0) << Said();
  const json some = json::parse(SlurpFile(folder_ / "some.geojson"));
  int nulls = 0;
  for (const json& feature : some["features"]) {
    const json& properties = feature["properties"];
    if (properties.contains("undecided")) continue;
    EXPECT_TRUE(properties.contains("witness"));
    nulls += properties.at("skyline_drop_m").is_null() ? 1 : 0;
  }
  EXPECT_GT(nulls, 0);
  EXPECT_THAT(Said(), HasSubstr(std::to_string(nulls) + " without a skyline drop"));
  const json shape = json::parse(
      SlurpFile(std::string(FARHORIZON_SOURCE_DIR) + "/proto/schemas/horizon.schema.json"));
  EXPECT_THAT(SchemaOffences(some, shape), testing::IsEmpty());
  std::vector<std::string> threads = short_of;
  threads.insert(threads.end(), {"--threads", "3"});
  ASSERT_EQ(Run("threads.geojson", threads), 0) << Said();
  EXPECT_EQ(SlurpFile(folder_ / "threads.geojson"), SlurpFile(folder_ / "some.geojson"));
}

TEST_F(HorizonE2e, DrawsTheSweepAtALevel) {
  ASSERT_EQ(Run("sweep.svg", {"--trace-level", "520.4"}), 0) << Said();
  const std::string svg = SlurpFile(folder_ / "sweep.svg");
  EXPECT_THAT(svg, testing::StartsWith("<svg "));
  EXPECT_THAT(svg, HasSubstr("hills.asc at 520 m")) << "the DEM's heights are whole metres";
  EXPECT_THAT(svg, HasSubstr("class=\"contours\""));
  ASSERT_EQ(Run("again.svg", {"--trace-level", "520.4", "--threads", "2"}), 0) << Said();
  EXPECT_EQ(SlurpFile(folder_ / "again.svg"), svg);
}

TEST_F(HorizonE2e, RefusesALevelWithoutASliceAndAPictureThatIsNoSvg) {
  EXPECT_EQ(Run("sweep.svg", {"--trace-level", "9999"}), 2);
  EXPECT_THAT(Said(), HasSubstr("no ground is cut at 9999 m; heights are 40"));
  EXPECT_EQ(Run("sweep.svg", {"--trace-level", "1e30"}), 2);
  EXPECT_EQ(Run("sweep.svg", {"--trace-level", "nan"}), 2);
  EXPECT_EQ(Run("sweep.svg", {"--trace-level", "high"}), 2);
  EXPECT_EQ(Run("sweep.geojson", {"--trace-level", "520"}), 2);
  EXPECT_THAT(Said(), HasSubstr("must end in .svg"));
  EXPECT_FALSE(std::filesystem::exists(folder_ / "sweep.svg"));
}

}  // namespace
}  // namespace farhorizon
