#include "service/handlers/routes.h"

#include <map>
#include <optional>
#include <set>
#include <sstream>

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

TEST_F(RoutesTest, AnswersWhatOpenapiSays) {
  // Paths stand at two blanks and methods at four: enough of YAML for a file that is ours.
  std::set<std::string> promised;
  std::istringstream file(SlurpFile(std::string(FARHORIZON_SOURCE_DIR) + "/proto/openapi.yaml"));
  std::string path;
  for (std::string line; std::getline(file, line);) {
    if (line.rfind("  /", 0) == 0) path = line.substr(2, line.size() - 3);
    for (const char* method : {"get", "post", "delete"}) {
      if (line == std::string("    ") + method + ":") promised.insert(method + (" " + path));
    }
  }
  std::set<std::string> kept;
  for (const Route& route : router_->routes()) {
    kept.insert(LowerCase(route.method) + " " + route.pattern);
  }
  EXPECT_EQ(kept, promised);
}

// A line "security: [{key: [SCOPE]}]" or "security: []" of each operation.
TEST_F(RoutesTest, NeedsTheScopesThatOpenapiSays) {
  std::map<std::string, std::string> promised;
  std::istringstream file(SlurpFile(std::string(FARHORIZON_SOURCE_DIR) + "/proto/openapi.yaml"));
  std::string path;
  std::string operation;
  for (std::string line; std::getline(file, line);) {
    if (line.rfind("  /", 0) == 0) path = line.substr(2, line.size() - 3);
    for (const char* method : {"get", "post", "delete"}) {
      if (line == std::string("    ") + method + ":") operation = method + (" " + path);
    }
    const std::string field = "      security: [";
    if (line.rfind(field, 0) != 0) continue;
    const std::size_t scope = line.find("{key: [");
    promised[operation] =
        scope == std::string::npos ? "" : line.substr(scope + 7, line.find(']') - scope - 7);
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
  const std::string api = SlurpFile(std::string(FARHORIZON_SOURCE_DIR) + "/proto/openapi.yaml");
  const std::string post = api.substr(0, api.find("    get:"));
  std::set<std::string> listed;
  const std::string row = "- {name: ";
  for (std::size_t at = 0; (at = post.find(row, at)) != std::string::npos; at += row.size()) {
    const std::size_t comma = post.find(',', at);
    if (post.compare(comma, 11, ", in: query") == 0) {
      listed.insert(post.substr(at + row.size(), comma - at - row.size()));
    }
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
  EXPECT_THAT(offences(Send("GET", "/jobs/x").body, "problem"), IsEmpty());
  const std::string root = FARHORIZON_SOURCE_DIR;
  EXPECT_THAT(offences(SlurpFile(root + "/proto/examples/problem.json"), "problem"), IsEmpty());
  EXPECT_THAT(offences("{}", "problem"), testing::SizeIs(6));
}

}  // namespace
}  // namespace farhorizon
