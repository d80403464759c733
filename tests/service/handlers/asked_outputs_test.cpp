#include "service/handlers/asked_outputs.h"

#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "service/jobs/job.h"

namespace farhorizon {
namespace {

using nlohmann::json;
using testing::HasSubstr;

// Why the outputs are refused; empty where they are not.
std::string WhyRefused(const json& outputs) {
  const auto asked = ReadAskedOutputs({{"outputs", outputs}}, kTerrainProcess);
  return asked ? "" : asked.error().message;
}

std::string WhyNotMade(const std::string& output, const BuildOptions& options) {
  const Status made = CheckOutputsOf({.outputs = {{{output, Transmission::kValue}}}}, options);
  return made ? "" : made.error().message;
}

TEST(AskedOutputs, HaveTheMediaTypeThatTheyAre) {
  const auto with = [](const char* name, const json& type) {
    return json{{name, {{"format", {{"mediaType", type}}}}}};
  };
  EXPECT_EQ(WhyRefused({{"tileset.json", json::object()}}), "");
  EXPECT_EQ(WhyRefused(with("tileset.json", "application/json")), "");
  EXPECT_EQ(WhyRefused(with("tileset.json", "Application/JSON; charset=utf-8")), "");
  EXPECT_EQ(WhyRefused({{"tileset.json", {{"format", json::object()}}}}), "");
  EXPECT_THAT(WhyRefused(with("tileset.json", "image/png")), HasSubstr("application/json"));
  EXPECT_THAT(WhyRefused(with("lod0.glb", 5)), HasSubstr("model/gltf-binary"));
  EXPECT_THAT(WhyRefused({{"lod.png", json::object()}}), HasSubstr("no output"));
}

TEST(AskedOutputs, AreThoseThatTheParametersLeaveRoomFor) {
  BuildOptions options;
  options.levels = 2;
  options.formats = {"drc", "geojson"};
  for (const char* made : {"lod0.drc", "lod1.drc", "lod1-horizon.glb", "horizon.geojson",
                           "report.json", "report.html", "manifest.json"}) {
    EXPECT_EQ(WhyNotMade(made, options), "") << made;
  }
  for (const auto& [output, format] : std::vector<std::pair<std::string, std::string>>{
           {"tileset.json", "3dtiles"},
           {"lod0.glb", "3dtiles"},
           {"horizon.fgb", "flatgeobuf"},
           {"horizon.gpkg", "geopackage"},
           {"layer.json", "quantized-mesh"},
           {"terrain-0-0-0.terrain", "quantized-mesh"}}) {
    EXPECT_THAT(WhyNotMade(output, options), HasSubstr("without " + format));
    options.formats.push_back(format);
    EXPECT_EQ(WhyNotMade(output, options), "") << output;
    options.formats = {"drc", "geojson"};
  }
  EXPECT_THAT(WhyNotMade("lod2.drc", options), HasSubstr("are 2, from 0 on"));
  EXPECT_THAT(WhyNotMade("lod10-horizon.glb", options), HasSubstr("are 2"));
  options.triangles = {500, 100, 20};
  EXPECT_EQ(WhyNotMade("lod2.drc", options), "");
  EXPECT_TRUE(CheckOutputsOf({}, options)) << "all that there are";
}

}  // namespace
}  // namespace farhorizon
