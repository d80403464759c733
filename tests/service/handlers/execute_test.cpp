#include "service/handlers/execute.h"

#include <memory>
#include <string>
#include <utility>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "tests/support/handlers_fixture.h"

namespace farhorizon {
namespace {

using nlohmann::json;
using testing::HasSubstr;

constexpr const char* kTerrain = "/processes/terrain-lod/execution";
constexpr const char* kEcho = "/processes/echo/execution";
constexpr const char* kTiff = "SUkqAC4uLi4=";  // of tiff_

class ExecuteTest : public HandlersTest {
 protected:
  void SetUp() override {
    HandlersTest::SetUp();
    router_ = std::make_unique<Router>(BuildRouter({*jobs_, "http://x", 1000, {}, nullptr, true}));
  }
  HttpResponse Execute(const std::string& target, const json& body,
                       std::vector<std::pair<std::string, std::string>> more = {}) {
    return Post(target, body.is_string() ? body.get<std::string>() : body.dump(),
                "application/json; charset=utf-8", std::move(more));
  }
  Job JobOf(const HttpResponse& response) {
    EXPECT_EQ(response.status, 201) << response.body;
    return *jobs_->Find(json::parse(response.body).value("jobID", ""));
  }
};

TEST_F(ExecuteTest, MakesAJobOfADemInBase64) {
  const HttpResponse response = Execute(
      kTerrain,
      {{"inputs",
        {{"dem", kTiff}, {"levels", 2}, {"filename", "a/b.tif"}, {"nodata", {-9999, "nan"}}}}});
  const Job job = JobOf(response);
  EXPECT_EQ(FieldOf(response, "Location"), "http://x/jobs/" + job.id);
  EXPECT_EQ(job.filename, "b.tif");
  EXPECT_EQ(job.input_bytes, 8);
  EXPECT_EQ(job.parameters, (Parameters{{"levels", "2"}, {"nodata", "-9999,nan"}}));
  EXPECT_EQ(job.answer, "") << "a document of all";
  EXPECT_EQ(json::parse(response.body)["processID"], "terrain-lod");
  EXPECT_EQ(FieldOf(response, "Preference-Applied"), "");
}

TEST_F(ExecuteTest, TakesQualifiedValuesAndJsonAtJobs) {
  const json body = {
      {"process", "http://x/processes/terrain-lod"},
      {"inputs",
       {{"dem",
         {{"value", kTiff}, {"format", {{"mediaType", "image/tiff"}, {"encoding", "base64"}}}}},
        {"levels", {{"value", 3}}}}},
      {"outputs", {{"lod0.glb", json::object()}}}};
  const Job job = JobOf(Execute("/jobs", body, {{"prefer", "respond-async "}}));
  EXPECT_EQ(job.parameters, (Parameters{{"levels", "3"}}));
  EXPECT_EQ(job.input_bytes, 8);
  EXPECT_EQ(job.answer, R"({"outputs":{"lod0.glb":"value"},"response":"raw"})");
}

TEST_F(ExecuteTest, RefusalsSayWhyAndLeaveNothingBehind) {
  struct Case {
    const char* target;
    json body;
    int status;
    const char* code;
  };
  const auto with = [](const char* name, json value) {
    return json{{"inputs", {{"dem", kTiff}, {name, std::move(value)}}}};
  };
  const std::vector<Case> cases = {
      {"/processes/none/execution", {{"inputs", json::object()}}, 404, "no-such-process"},
      {"/jobs", {{"process", "none"}, {"inputs", json::object()}}, 404, "no-such-process"},
      {"/processes/echo/execution?pause=1", {{"inputs", json::object()}}, 400, "invalid-parameter"},
      {kTerrain, "{", 400, "invalid-json"},
      {kTerrain, R"({"inputs": {"dem": "", "dem": ""}})", 400, "invalid-json"},
      {kTerrain, json::array(), 400, "invalid-parameter"},
      {kTerrain, {{"invalid-execute-request", "true"}}, 400, "invalid-parameter"},
      {kTerrain, {{"inputs", json::object()}}, 400, "invalid-parameter"},
      {kTerrain, {{"inputs", {{"dem", 3}}}}, 400, "invalid-parameter"},
      {kTerrain, {{"inputs", {{"dem", "*"}}}}, 400, "invalid-parameter"},
      {kTerrain, {{"inputs", {{"dem", {"SUkq"}}}}}, 400, "invalid-parameter"},
      {kTerrain, {{"inputs", {{"dem", {{"type", "wrong/type_x"}}}}}}, 400, "invalid-parameter"},
      {kTerrain, {{"inputs", {{"dem", {{"href", "http://127.0.0.1/"}}}}}}, 403, "href-not-allowed"},
      {kTerrain,
       {{"inputs", {{"dem", {{"value", kTiff}, {"encoding", "gzip"}}}}}},
       400,
       "invalid-parameter"},
      {kTerrain,
       {{"inputs", {{"dem", {{"value", kTiff}, {"mediaType", "image/png"}}}}}},
       415,
       "unsupported-media-type"},
      {kTerrain, {{"inputs", {{"dem", "aGVsbG8="}}}}, 415, "not-a-raster"},
      {kTerrain, with("levels", 99), 400, "invalid-parameter"},
      {kTerrain, with("levls", 2), 400, "unknown-parameter"},
      {kTerrain, with("crs", {{"href", "file:///etc/passwd"}}), 403, "href-not-allowed"},
      {kTerrain,
       {{"inputs", {{"dem", kTiff}}}, {"outputs", {{"none", json::object()}}}},
       400,
       "invalid-parameter"},
      {kTerrain, {{"inputs", {{"dem", kTiff}}}, {"response", "xml"}}, 400, "invalid-parameter"},
      {kTerrain, std::string(1001, ' '), 413, "body-too-large"},
      {kEcho, {{"inputs", {{"none", 1}}}}, 400, "invalid-parameter"},
      {kEcho, {{"inputs", {{"pause", 61}}}}, 400, "invalid-parameter"},
      {kEcho, {{"inputs", {{"image", {{"type", "wrong/type_x"}}}}}}, 400, "invalid-parameter"}};
  for (const Case& one : cases) {
    const HttpResponse response = Execute(one.target, one.body);
    EXPECT_EQ(response.status, one.status) << one.body << response.body;
    EXPECT_EQ(CodeOf(response), one.code) << one.body << response.body;
    EXPECT_EQ(FilesLeft(), 0U) << one.body;
  }
  EXPECT_EQ(FieldOf(Execute(kTerrain, "{", {{"accept", "application/json"}}), "Content-Type"),
            "application/json");
  const HttpResponse form = Post(kTerrain, tiff_, "image/tiff");
  EXPECT_EQ(CodeOf(form), "unsupported-media-type");
  EXPECT_EQ(FieldOf(form, "Accept-Post"), "application/json");
}

TEST_F(ExecuteTest, AnEchoThatIsNotAnsweredInTimeIsAJob) {
  const json body = {{"inputs", {{"text", "hi"}, {"pause", 1}}}};
  const Job job = JobOf(Execute(kEcho, body, {{"prefer", "wait=0"}}));
  EXPECT_EQ(job.process, "echo");
  EXPECT_THAT(job.answer, HasSubstr(R"("text":"value")"));
  const HttpResponse later = Execute(kEcho, body, {{"prefer", "respond-async"}});
  EXPECT_EQ(FieldOf(later, "Preference-Applied"), "respond-async");
  EXPECT_EQ(json::parse(later.body)["processID"], "echo");
  EXPECT_EQ(json::parse(Send("GET", "/jobs?processID=echo").body)["jobs"].size(), 2U);
  EXPECT_EQ(json::parse(Send("GET", "/jobs?processID=terrain-lod").body)["jobs"].size(), 0U);
}

TEST_F(ExecuteTest, OneKeyMakesOneJob) {
  const json body = {{"inputs", {{"dem", kTiff}}}};
  const Job job = JobOf(Execute(kTerrain, body, {{"idempotency-key", "k"}}));
  EXPECT_EQ(JobOf(Execute("/jobs", body, {{"idempotency-key", "k"}})).id, job.id);
  json other = body;
  other["response"] = "raw";
  EXPECT_EQ(CodeOf(Execute(kTerrain, other, {{"idempotency-key", "k"}})), "idempotency-key-reused");
}

}  // namespace
}  // namespace farhorizon
