#include "service/handlers/result_answer.h"

#include <memory>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "service/clock.h"
#include "service/jobs/local_object_store.h"
#include "service/jobs/sqlite_job_store.h"
#include "tests/support/handlers_fixture.h"

namespace farhorizon {
namespace {

using nlohmann::json;
using testing::HasSubstr;

struct Left {
  const char* name;
  const char* media_type;
  std::string bytes;
};

class ResultAnswerTest : public HandlersTest {
 protected:
  void SetUp() override {
    HandlersTest::SetUp();
    router_ = std::make_unique<Router>(BuildRouter({*jobs_, "http://x", 1000, {}, nullptr, true}));
  }
  // The results of an echo that asks so, after a worker has left these artifacts.
  HttpResponse Results(const json& asked, const std::vector<Left>& artifacts) {
    json body = asked;
    body["inputs"] = json::object();
    const HttpResponse made =
        Send("POST", "/processes/echo/execution",
             {{"content-type", "application/json"}, {"prefer", "wait=0"}}, body.dump());
    EXPECT_EQ(made.status, 201) << made.body;
    path_ = "/jobs/" + json::parse(made.body).value("jobID", "");
    auto store = OpenSqliteJobStore(folder_ / "data" / "jobs.sqlite");
    auto objects = OpenLocalObjectStore(folder_ / "data" / "objects");
    const auto job = (*store)->ClaimNext(NowMs(), {});
    std::vector<Artifact> stored;
    for (const Left& left : artifacts) {
      SpillFile(folder_ / "left", left.bytes);
      const auto object = (*objects)->PutFile(folder_ / "left");
      stored.push_back({left.name, left.media_type, object->bytes, object->sha256});
    }
    EXPECT_TRUE(*(*store)->Publish((*job)->id, (*job)->run, stored, {}, NowMs()));
    return Send("GET", path_ + "/results");
  }

  std::string path_;
  const std::vector<Left> two_ = {{"box", "application/json", R"({"bbox":[1,2,3,4]})"},
                                  {"image", "image/tiff", "II"},
                                  {"manifest.json", "application/json", "{}"},
                                  {"object", "application/json", R"({"a":1})"},
                                  {"text", "text/plain", "hi"}};
};

TEST_F(ResultAnswerTest, IsADocumentOfValuesAndLinks) {
  const HttpResponse response = Results({{"response", "document"},
                                         {"outputs",
                                          {{"box", json::object()},
                                           {"image", json::object()},
                                           {"numbers", json::object()},
                                           {"object", json::object()},
                                           {"text", {{"transmissionMode", "reference"}}}}}},
                                        two_);
  EXPECT_EQ(response.status, 200);
  EXPECT_EQ(FieldOf(response, "Content-Type"), "application/json");
  json document = json::parse(response.body);
  EXPECT_EQ(document["text"]["href"], "http://x" + path_ + "/results/text");
  document.erase("text");
  EXPECT_EQ(document, json::parse(R"({"box": {"bbox": [1, 2, 3, 4]},
      "object": {"value": {"a": 1}, "mediaType": "application/json"},
      "image": {"value": "SUk=", "mediaType": "image/tiff", "encoding": "base64"}})"));
}

TEST_F(ResultAnswerTest, IsTheBytesOfOneOutput) {
  const HttpResponse response = Results({{"outputs", {{"text", json::object()}}}}, two_);
  EXPECT_EQ(response.status, 200);
  EXPECT_EQ(FieldOf(response, "Content-Type"), "text/plain");
  ASSERT_TRUE(response.file);
  EXPECT_EQ(*response.file->source->Read(0, 2), "hi");
}

TEST_F(ResultAnswerTest, HasAPartForEachOfSeveral) {
  const HttpResponse response = Results(
      {{"outputs", {{"image", {{"transmissionMode", "reference"}}}, {"text", json::object()}}}},
      two_);
  const std::string type = FieldOf(response, "Content-Type");
  EXPECT_EQ(type.rfind("multipart/related; type=\"image/tiff\"; boundary=", 0), 0U) << type;
  const std::string line = "--" + type.substr(type.rfind('=') + 1);
  EXPECT_EQ(response.body, line + "\r\nContent-Type: image/tiff\r\nContent-ID: <image>\r\n" +
                               "Content-Location: http://x" + path_ + "/results/image\r\n\r\n\r\n" +
                               line + "\r\nContent-Type: text/plain\r\nContent-ID: <text>\r\n" +
                               "\r\nhi\r\n" + line + "--\r\n");
  const std::string etag = FieldOf(response, "ETag");
  EXPECT_EQ(Send("GET", path_ + "/results", {{"if-none-match", etag}}).status, 304);
}

TEST_F(ResultAnswerTest, IsLinksWhereAllAreReferences) {
  const HttpResponse response =
      Results({{"outputs", {{"text", {{"transmissionMode", "reference"}}}}}}, two_);
  EXPECT_EQ(response.status, 204);
  EXPECT_THAT(FieldOf(response, "Link"), HasSubstr("<http://x" + path_ + "/results/text>; rel="));
  EXPECT_EQ(Results({{"outputs", json::object()}}, {}).status, 204) << "nothing was asked for";
}

TEST_F(ResultAnswerTest, LinksToValuesThatAreTooLarge) {
  const std::string large((std::size_t{4} << 20U) - 1, 'x');
  const HttpResponse response = Results(
      {{"response", "document"}}, {{"image", "image/tiff", "II"}, {"text", "text/plain", large}});
  const json document = json::parse(response.body);
  EXPECT_TRUE(document["image"].contains("value"));
  EXPECT_TRUE(document["text"].contains("href"));
}

}  // namespace
}  // namespace farhorizon
