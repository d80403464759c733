#include "service/handlers/routes.h"

#include <map>
#include <optional>
#include <set>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "core/pipeline/build_options.h"
#include "service/handlers/route_scopes.h"
#include "tests/support/handlers_fixture.h"
#include "tests/support/json_schema.h"

namespace farhorizon {
namespace {

using nlohmann::json;

using RoutesTest = HandlersTest;

json OpenApi() {
  return json::parse(SlurpFile(std::string(FARHORIZON_SOURCE_DIR) + "/proto/openapi.yaml"));
}

TEST_F(RoutesTest, AnswersWhatOpenapiSays) {
  std::set<std::string> promised;
  const json api = OpenApi();
  for (const auto& [path, item] : api["paths"].items()) {
    for (const char* method : {"get", "post", "patch", "delete", "options"}) {
      if (item.contains(method)) promised.insert(method + (" " + path));
    }
  }
  std::set<std::string> kept;
  for (const Route& route : router_->routes()) {
    kept.insert(LowerCase(route.method) + " " + route.pattern);
  }
  EXPECT_EQ(kept, promised);
}

TEST_F(RoutesTest, NeedsTheScopesThatOpenapiSays) {
  std::map<std::string, std::string> promised;
  const json api = OpenApi();
  for (const auto& [path, item] : api["paths"].items()) {
    for (const char* method : {"get", "post", "patch", "delete", "options"}) {
      if (!item.contains(method)) continue;
      const json security = item[method].value("security", json::array({"none stated"}));
      promised[method + (" " + path)] =
          security.empty() ? "" : security[0].at("key").at(0).get<std::string>();
    }
  }
  std::map<std::string, std::string> kept;
  for (const Route& route : router_->routes()) {
    const std::optional<Scope> needed = NeededScope(route.method, route.pattern);
    kept[LowerCase(route.method) + " " + route.pattern] =
        needed ? kScopeNames.at(static_cast<std::size_t>(*needed)) : "";
  }
  EXPECT_EQ(kept, promised);
}

TEST_F(RoutesTest, TakesTheParametersThatOpenapiLists) {
  std::set<std::string> listed;
  const json api = OpenApi();
  for (const json& one : api["paths"]["/jobs"]["post"]["parameters"]) {
    if (one["in"] == "query") listed.insert(one["name"].get<std::string>());
  }
  std::set<std::string> taken = {"filename", "priority", "deadline", "timeout"};
  for (const std::string_view name : ParameterNames()) taken.emplace(name);
  EXPECT_EQ(listed, taken);
}

TEST_F(RoutesTest, AnswersInTheShapesOfTheSchemas) {
  const auto offences = [](const std::string& body, const std::string& schema) {
    const std::string root = FARHORIZON_SOURCE_DIR;
    const json shape = json::parse(SlurpFile(root + "/proto/schemas/" + schema + ".schema.json"));
    return SchemaOffences(json::parse(body), shape);
  };
  using testing::IsEmpty;
  const HttpResponse job = Post("/jobs", tiff_);
  EXPECT_THAT(offences(job.body, "status-info"), IsEmpty());
  EXPECT_THAT(offences(Send("GET", "/jobs").body, "job-list"), IsEmpty());
  const HttpResponse upload =
      Send("POST", "/uploads", {{"tus-resumable", "1.0.0"}, {"upload-length", "5"}});
  EXPECT_THAT(offences(Send("GET", "/uploads/" + upload.upload_id).body, "upload"), IsEmpty());
  EXPECT_THAT(offences(Send("GET", "/jobs/x").body, "problem"), IsEmpty());
  EXPECT_THAT(offences(Send("GET", "/").body, "landing"), IsEmpty());
  EXPECT_THAT(offences(Send("GET", "/conformance").body, "conformance"), IsEmpty());
  EXPECT_THAT(offences(Send("GET", "/processes").body, "process-list"), IsEmpty());
  const std::string root = FARHORIZON_SOURCE_DIR;
  EXPECT_THAT(offences(SlurpFile(root + "/proto/examples/problem.json"), "problem"), IsEmpty());
  EXPECT_THAT(offences("{}", "problem"), testing::SizeIs(6));
}

}  // namespace
}  // namespace farhorizon
