#include "service/handlers/processes.h"

#include <memory>
#include <set>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "core/pipeline/build_options.h"
#include "tests/support/handlers_fixture.h"
#include "tests/support/json_schema.h"

namespace farhorizon {
namespace {

using nlohmann::json;

class ProcessesTest : public HandlersTest {
 protected:
  void OfferEcho() {
    router_ = std::make_unique<Router>(BuildRouter({*jobs_, "http://x", 1000, {}, nullptr, true}));
  }
};

TEST_F(ProcessesTest, AreListedAndDescribed) {
  const json list = json::parse(Send("GET", "/processes").body);
  ASSERT_EQ(list["processes"].size(), 1U) << "echo is off";
  EXPECT_EQ(CodeOf(Send("GET", "/processes/echo")), "no-such-process");
  OfferEcho();
  EXPECT_EQ(json::parse(Send("GET", "/processes").body)["processes"].size(), 2U);
  EXPECT_EQ(json::parse(Send("GET", "/processes?limit=1").body)["processes"].size(), 1U);
  for (const char* query : {"limit=0", "limit=10001", "limit=x", "x=1"}) {
    EXPECT_EQ(CodeOf(Send("GET", std::string("/processes?") + query)),
              "invalid-query-parameter-value")
        << query;
  }
  const std::string root = FARHORIZON_SOURCE_DIR;
  const json shape = json::parse(SlurpFile(root + "/proto/schemas/process.schema.json"));
  for (const char* name : {"terrain-lod", "echo"}) {
    const HttpResponse response = Send("GET", std::string("/processes/") + name);
    EXPECT_THAT(SchemaOffences(json::parse(response.body), shape), testing::IsEmpty()) << name;
  }
}

TEST_F(ProcessesTest, HaveAsInputsWhatAJobCanBeAskedFor) {
  const json inputs = json::parse(Send("GET", "/processes/terrain-lod").body)["inputs"];
  std::set<std::string> described;
  for (const auto& [name, input] : inputs.items()) described.insert(name);
  std::set<std::string> taken = {"dem", "filename", "priority", "deadline", "timeout"};
  for (const std::string_view name : ParameterNames()) taken.emplace(name);
  EXPECT_EQ(described, taken);
  EXPECT_EQ(inputs["maxError"]["schema"]["exclusiveMinimum"], true) << "as OpenAPI 3.0 has it";
}

TEST(MayHaveOutput, KnowsThoseThatParametersDecide) {
  for (const char* name :
       {"tileset.json", "lod11.drc", "lod0-horizon.glb", "terrain-3-1-2.terrain"}) {
    EXPECT_TRUE(MayHaveOutput("terrain-lod", name)) << name;
  }
  for (const char* name : {"lod12.drc", "text", "terrain-a.terrain", ""}) {
    EXPECT_FALSE(MayHaveOutput("terrain-lod", name)) << name;
  }
  EXPECT_TRUE(MayHaveOutput("echo", "text"));
  EXPECT_FALSE(MayHaveOutput("echo", "pause"));
}

}  // namespace
}  // namespace farhorizon
