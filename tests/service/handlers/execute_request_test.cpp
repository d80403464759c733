#include "service/handlers/execute_request.h"

#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "tests/support/handlers_fixture.h"

namespace farhorizon {
namespace {

using nlohmann::json;

class ExecuteRequestTest : public HandlersTest {
 protected:
  // What the body wishes for of this process, as text.
  std::string Wishes(const std::string& process, const json& asked) {
    json body = asked;
    body["inputs"] = json::object();
    const HandlerContext context{*jobs_, "http://x", 1000, {}, nullptr, true};
    const auto read = ReadExecuteRequest(context, body.dump(), process);
    return read ? WriteResultWishes(read->wishes) : read.error().message;
  }
};

TEST_F(ExecuteRequestTest, WithoutAWishEachProcessAnswersAsIsUsual) {
  EXPECT_EQ(Wishes("terrain-lod", {}), "");
  EXPECT_EQ(Wishes("terrain-lod", {{"response", "raw"}}), R"({"response":"raw"})");
  const json one = {{"outputs", {{"lod0.drc", json::object()}}}};
  EXPECT_EQ(Wishes("terrain-lod", one), R"({"outputs":{"lod0.drc":"value"},"response":"raw"})");
  json document = one;
  document["response"] = "document";
  EXPECT_EQ(Wishes("terrain-lod", document),
            R"({"outputs":{"lod0.drc":"reference"},"response":"document"})");
  const json two = {
      {"outputs",
       {{"lod0.drc", json::object()}, {"report.json", {{"transmissionMode", "value"}}}}}};
  EXPECT_EQ(Wishes("terrain-lod", two),
            R"({"outputs":{"lod0.drc":"reference","report.json":"value"},"response":"document"})");
  EXPECT_EQ(Wishes("echo", {{"outputs", {{"text", json::object()}}}, {"response", "document"}}),
            R"({"outputs":{"text":"value"},"response":"document"})");
  EXPECT_EQ(Wishes("echo", {}), R"({"outputs":{"box":"value","image":"value","numbers":"value",)"
                                R"("object":"value","text":"value"},"response":"raw"})");
  EXPECT_EQ(Wishes("echo", {{"outputs", json::object()}}), R"({"outputs":{},"response":"raw"})");
}

TEST_F(ExecuteRequestTest, RefusesWhatCannotBeMeant) {
  for (const json& asked : std::vector<json>{{{"response", 1}},
                                             {{"outputs", {"text"}}},
                                             {{"outputs", {{"text", 1}}}},
                                             {{"outputs", {{"text", {{"transmissionMode", "x"}}}}}},
                                             {{"process", "terrain-lod"}},
                                             {{"subscriber", json::object()}}}) {
    EXPECT_EQ(Wishes("echo", asked).find('{'), std::string::npos) << asked;
  }
}

}  // namespace
}  // namespace farhorizon
