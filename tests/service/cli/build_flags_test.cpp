#include "service/cli/build_flags.h"

#include <CLI/CLI.hpp>
#include <gtest/gtest.h>

#include "service/cli/dem_command.h"

namespace farhorizon {
namespace {

// The arguments of a command that has all flags of a build.
DemArguments Parsed(const std::string& line) {
  DemArguments arguments;
  CLI::App app;
  Command command(app);
  AddDem(command, arguments);
  AddBuildFlags(command, arguments.flags);
  AddRunFlags(command, arguments);
  app.parse(line);
  return arguments;
}

TEST(BuildFlags, AreTheParametersOfAJob) {
  const DemArguments arguments = Parsed(
      "a.tif --levels 3 --max-error 2.5 --silhouette-error 1 --formats drc,geojson "
      "--crs EPSG:32611 --vertical-datum EPSG:5703 --height-unit ft --datum-operation EPSG:1693 "
      "--nodata -9999 --work-budget 1000 --approximate --skirt 20 "
      "--tile-triangles 50000 --frame -122.5,37.75 --apron 8");
  EXPECT_EQ(arguments.path, "a.tif");
  EXPECT_EQ(arguments.flags.parameters, (Parameters{{"levels", "3"},
                                                    {"maxError", "2.5"},
                                                    {"silhouetteError", "1"},
                                                    {"formats", "drc,geojson"},
                                                    {"crs", "EPSG:32611"},
                                                    {"verticalDatum", "EPSG:5703"},
                                                    {"heightUnit", "ft"},
                                                    {"datumOperation", "EPSG:1693"},
                                                    {"nodata", "-9999"},
                                                    {"workBudget", "1000"},
                                                    {"approximate", "true"},
                                                    {"skirt", "20"},
                                                    {"tileTriangles", "50000"},
                                                    {"frame", "-122.5,37.75"},
                                                    {"apron", "8"}}));
}

TEST(BuildFlags, AreThoseOfAllParameters) {
  CLI::App app;
  Command command(app);
  BuildFlags flags;
  AddBuildFlags(command, flags);
  for (const std::string_view name : ParameterNames()) {
    EXPECT_NE(app.get_option_no_throw(FlagOf(name)), nullptr) << name;
  }
}

TEST(BuildFlags, TakeNoDataMoreThanOnce) {
  for (const char* line :
       {"--nodata -9999 a.tif --nodata -inf", "a.tif --nodata=-9999 --nodata=-inf",
        "--nodata -9999,-inf a.tif", "--nodata -9999 --nodata -inf a.tif"}) {
    const DemArguments arguments = Parsed(line);
    EXPECT_EQ(arguments.path, "a.tif") << line;
    EXPECT_EQ(arguments.flags.parameters, (Parameters{{"nodata", "-9999,-inf"}})) << line;
  }
  Result<BuildOptions> options = Parsed("a.tif --nodata nan --nodata -1e+30").flags.Options();
  ASSERT_TRUE(options) << options.error().message;
  EXPECT_EQ(options->nodata.size(), 2U);
  EXPECT_THROW(Parsed("a.tif --nodata"), CLI::ParseError);
}

TEST(BuildFlags, TakeTrianglesAsAListOrOneByOne) {
  for (const char* line : {"--triangles 9000,500 a.tif", "a.tif --triangles=9000 --triangles=500",
                           "--triangles 9000 a.tif --triangles 500"}) {
    const DemArguments arguments = Parsed(line);
    EXPECT_EQ(arguments.path, "a.tif") << line;
    EXPECT_EQ(arguments.flags.parameters, (Parameters{{"triangles", "9000,500"}})) << line;
  }
  EXPECT_FALSE(Parsed("a.tif --triangles 500 --levels 3").flags.Options());
}

TEST(BuildFlags, BecomeTheOptionsOfABuild) {
  Result<BuildOptions> options =
      Parsed("a.tif --levels 3 --crs EPSG:32611 --threads 2").flags.Options();
  ASSERT_TRUE(options) << options.error().message;
  EXPECT_EQ(options->levels, 3);
  EXPECT_EQ(options->crs, "EPSG:32611");
  EXPECT_EQ(options->threads, 2);
}

TEST(BuildFlags, TakeAllCoresUnlessTold) {
  Result<BuildOptions> options = Parsed("a.tif").flags.Options();
  ASSERT_TRUE(options);
  EXPECT_GE(options->threads, 1);
  EXPECT_THROW(Parsed("a.tif --threads 0"), CLI::ParseError);
}

TEST(BuildFlags, RefuseWhatAJobRefuses) {
  for (const char* line : {"a.tif --levels 99", "a.tif --levels x", "a.tif --max-error -1",
                           "a.tif --nodata -9999 --nodata x", "a.tif --height-unit yd"}) {
    Result<BuildOptions> options = Parsed(line).flags.Options();
    ASSERT_FALSE(options) << line;
    EXPECT_EQ(options.error().code, ErrorCode::kInvalidArgument) << line;
    EXPECT_EQ(options.error().message.substr(0, 2), "--") << options.error().message;
  }
  EXPECT_THROW(Parsed("a.tif --levles 2"), CLI::ParseError);
  EXPECT_THROW(Parsed("--levels 2"), CLI::ParseError);
}

TEST(RunOnDem, GivesOptionsToTheWorkAndReturnsItsAnswer) {
  const DemArguments arguments = Parsed("a.tif --levels 4 --progress none");
  const Result<int> levels =
      RunOnDem(arguments, Workflow::kBuild,
               [](const DemRun& run) -> Result<int> { return run.options.levels; });
  ASSERT_TRUE(levels);
  EXPECT_EQ(*levels, 4);
}

TEST(RunOnDem, DoesNoWorkWithInvalidFlags) {
  bool worked = false;
  Status done =
      RunOnDem(Parsed("a.tif --levels 99"), Workflow::kBuild, [&](const DemRun&) -> Status {
        worked = true;
        return Ok{};
      });
  EXPECT_FALSE(done);
  EXPECT_FALSE(worked);
}

}  // namespace
}  // namespace farhorizon
