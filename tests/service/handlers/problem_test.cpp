// The error codes of the wire contract: the statuses, proto/errors.md, the schema and the sources
// are held to core/base/error_kind.h.
#include "service/handlers/problem.h"

#include <filesystem>
#include <map>
#include <regex>
#include <set>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "tests/support/temp_dir.h"

namespace farhorizon {
namespace {

using nlohmann::json;
using testing::IsEmpty;

const std::filesystem::path kRoot = FARHORIZON_SOURCE_DIR;

std::map<std::string, int> StatusesByKind() {
  std::map<std::string, int> statuses;
  for (const std::string_view name : kErrorKinds) {
    statuses.emplace(name, HttpStatusOf(*ErrorKind::FromName(name)));
  }
  return statuses;
}

// The sources of core/ and service/ in which an error can be made, except the lists themselves.
std::string SourcesThatMakeErrors() {
  std::string all;
  for (const char* folder : {"core", "service"}) {
    for (const auto& entry : std::filesystem::recursive_directory_iterator(kRoot / folder)) {
      const std::string name = entry.path().filename().string();
      const std::string ending = entry.path().extension().string();
      const bool list = name == "error_kind.h" || name == "problem.cpp";
      if ((ending == ".h" || ending == ".cpp") && !list) all += SlurpFile(entry.path());
    }
  }
  return all;
}

std::set<std::string> FirstGroups(const std::string& text, const std::string& pattern) {
  const std::regex regex(pattern);
  std::set<std::string> found;
  for (std::sregex_iterator it(text.begin(), text.end(), regex), end; it != end; ++it) {
    found.insert((*it)[1]);
  }
  return found;
}

TEST(ErrorContract, TheTableHasEveryCodeOnceWithItsStatus) {
  const std::string table = SlurpFile(kRoot / "proto" / "errors.md");
  const std::regex row(R"(\n\| `([a-z0-9-]+)` \| (\d+) \| ([^|\n]{5,}) \| ([^|\n]{5,}) \|(?=\n))");
  std::map<std::string, int> listed;
  for (std::sregex_iterator it(table.begin(), table.end(), row), end; it != end; ++it) {
    EXPECT_TRUE(listed.emplace((*it)[1], std::stoi((*it)[2])).second) << (*it)[1] << " twice";
  }
  EXPECT_EQ(listed, StatusesByKind());
  EXPECT_EQ(FirstGroups(table, "\n\\| `([^`]*)`").size(), listed.size()) << "an ill-formed row";
}

TEST(ErrorContract, TheSchemaHasEveryCode) {
  const json schema = json::parse(SlurpFile(kRoot / "proto/schemas/problem.schema.json"));
  const auto codes = schema["properties"]["code"]["enum"].get<std::vector<std::string>>();
  EXPECT_EQ(codes, std::vector<std::string>(kErrorKinds.begin(), kErrorKinds.end()));
}

TEST(ErrorContract, TheSourcesUseEveryCode) {
  const std::string sources = SourcesThatMakeErrors();
  std::vector<std::string> unused;
  for (const std::string_view name : kErrorKinds) {
    const std::string literal = "\"" + std::string(name) + "\"";
    if (sources.find(literal) == std::string::npos) unused.emplace_back(name);
  }
  EXPECT_THAT(unused, IsEmpty());
}

TEST(ErrorContract, TheSourcesAskForNoOtherCode) {
  // The compiler checks the literals that make an ErrorKind, not those that one is compared with.
  for (const std::string& name :
       FirstGroups(SourcesThatMakeErrors(), R"re(kind [=!]= "([^"]*)")re")) {
    EXPECT_TRUE(ErrorKind::FromName(name)) << name;
  }
}

TEST(ProblemOf, HasTheKindOrElseTheClassAsItsCode) {
  const Problem kind =
      ProblemOf({ErrorCode::kUnsupportedData, "the DEM has 3 bands", "several-bands"});
  EXPECT_EQ(kind.status, 422);
  EXPECT_EQ(kind.code, "several-bands");
  EXPECT_EQ(kind.detail, "the DEM has 3 bands");
  const Problem bare = ProblemOf({ErrorCode::kNotFound, "no such object"});
  EXPECT_EQ(bare.status, 404);
  EXPECT_EQ(bare.code, "not-found");
}

TEST(ProblemOf, NamesParametersWhereTheMessageNamesFlags) {
  EXPECT_EQ(
      ProblemOf({ErrorCode::kUnsupportedData, "void; give --nodata -9999", "all-nodata"}).detail,
      "void; give nodata=-9999");
}

TEST(ProblemOf, TellsNothingOfFailuresOfTheMachine) {
  EXPECT_THAT(ProblemOf({ErrorCode::kIo, "/data: disk gone", "storage"}).detail,
              testing::Not(testing::HasSubstr("/data")));
  EXPECT_EQ(ProblemOf({ErrorCode::kIo, "it died", "worker-crashed"}).detail, "it died");
  EXPECT_EQ(ProblemOf({ErrorCode::kIo, "send it again", "input-corrupt"}).detail, "send it again");
}

TEST(ProblemType, IsOgcsWhereOgcHasOne) {
  EXPECT_EQ(ProblemType("no-such-job"),
            "http://www.opengis.net/def/exceptions/ogcapi-processes-1/1.0/no-such-job");
  EXPECT_EQ(ProblemType("no-crs"), "urn:farhorizon:problem:no-crs");
}

TEST(ProblemResponse, IsPlainJsonForClientsThatTakeNothingElse) {
  const auto type_for = [](const std::string& accept) {
    HttpRequest request;
    request.headers = {{"accept", accept}};
    return ProblemResponse(request, {"no-crs", "why"}).headers.at(0).second;
  };
  EXPECT_EQ(type_for("application/json"), "application/json");
  EXPECT_EQ(type_for("application/json, */*"), "application/problem+json");
  EXPECT_EQ(type_for("text/html"), "application/problem+json");
}

TEST(ProblemResponse, SaysWhenToTryAgain) {
  const auto fields = [](const Problem& problem) { return ProblemResponse({}, problem).headers; };
  const std::pair<std::string, std::string> retry = {"Retry-After", "5"};
  EXPECT_THAT(fields({"queue-full", "why"}), testing::Contains(retry));
  EXPECT_THAT(fields({"no-crs", "why"}), testing::Not(testing::Contains(retry)));
}

}  // namespace
}  // namespace farhorizon
