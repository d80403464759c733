// Handlers without sockets or workers: what they say from the head, the first bytes and the store.
#include <memory>
#include <set>
#include <sstream>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "service/handlers/json.h"
#include "service/handlers/problem.h"
#include "service/handlers/raster_sniff.h"
#include "service/handlers/routes.h"
#include "tests/support/json_schema.h"
#include "tests/support/temp_dir.h"

namespace farhorizon {
namespace {

using nlohmann::json;

class HandlersTest : public testing::Test {
 protected:
  void SetUp() override {
    JobServiceOptions options;
    options.data = folder_ / "data";
    options.workers = 0;  // nothing runs: jobs stay where the test puts them
    options.max_waiting = 2;
    options.min_free_bytes = 0;
    options.probe.max_bytes = -1;  // no worker looks at uploads
    auto opened = JobService::Open(options);
    ASSERT_TRUE(opened) << opened.error().message;
    jobs_ = *std::move(opened);
    router_ = std::make_unique<Router>(BuildRouter({*jobs_, "http://x", 1000}));
  }

  HttpResponse Send(const std::string& method, const std::string& target,
                    std::vector<std::pair<std::string, std::string>> headers = {},
                    const std::string& body = "") {
    HttpRequest request;
    request.method = method;
    request.target = target;
    request.path = target.substr(0, target.find('?'));
    if (request.path.size() < target.size()) request.query = target.substr(request.path.size() + 1);
    request.headers = std::move(headers);
    if (!body.empty()) request.content_length = static_cast<std::int64_t>(body.size());
    Admission admission = router_->Begin(request);
    if (admission.answer) return *admission.answer;
    if (admission.sink) {
      Status written = admission.sink->Write(body);
      if (!written) return ProblemResponse(request, ProblemOf(written.error()));
    }
    return router_->Finish(request, admission.sink.get());
  }
  HttpResponse Post(const std::string& target, const std::string& body,
                    const std::string& type = "image/tiff",
                    std::vector<std::pair<std::string, std::string>> more = {}) {
    more.emplace_back("content-type", type);
    return Send("POST", target, more, body);
  }
  static std::string CodeOf(const HttpResponse& response) {
    return json::parse(response.body).value("code", "");
  }
  static std::string FieldOf(const HttpResponse& response, const std::string& name) {
    for (const auto& [key, value] : response.headers) {
      if (key == name) return value;
    }
    return "";
  }
  [[nodiscard]] std::size_t FilesLeft() const {
    std::size_t count = 0;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(folder_.path())) {
      const std::string name = entry.path().filename().string();
      count += entry.is_regular_file() && name != "lock" && name.find("jobs.sqlite") != 0 ? 1 : 0;
    }
    return count;
  }

  const std::string tiff_{"II*\0....", 8};
  TempDir folder_;
  std::unique_ptr<JobService> jobs_;
  std::unique_ptr<Router> router_;
};

TEST_F(HandlersTest, AcceptsATiff) {
  const HttpResponse response = Post("/jobs?levels=2&filename=a/b.tif", tiff_);
  ASSERT_EQ(response.status, 201) << response.body;
  const json info = json::parse(response.body);
  EXPECT_EQ(info["status"], "accepted");
  EXPECT_EQ(info["filename"], "b.tif");
  EXPECT_EQ(FieldOf(response, "Location"), "http://x/jobs/" + info.value("jobID", ""));
  EXPECT_EQ(FieldOf(response, "Retry-After"), "1");
  EXPECT_EQ(Send("GET", "/jobs/" + info.value("jobID", "")).status, 200);
  EXPECT_EQ(FilesLeft(), 1U);
}

TEST_F(HandlersTest, AcceptsAForm) {
  const std::string form =
      "--B\r\nContent-Disposition: form-data; name=params\r\n\r\n"
      "{\"levels\": 3, \"formats\": [\"3dtiles\", \"drc\"]}\r\n"
      "--B\r\nContent-Disposition: form-data; name=dem; filename=c.tif\r\n\r\n" +
      tiff_ + "\r\n--B--\r\n";
  const HttpResponse response = Post("/jobs", form, "multipart/form-data; boundary=B");
  ASSERT_EQ(response.status, 201) << response.body;
  const auto job = jobs_->Find(json::parse(response.body).value("jobID", ""));
  EXPECT_EQ(job->parameters, (Parameters{{"levels", "3"}, {"formats", "3dtiles,drc"}}));
  EXPECT_EQ(job->filename, "c.tif");
  EXPECT_EQ(job->input_bytes, 8);
}

TEST_F(HandlersTest, RefusalsSayWhyAndLeaveNothingBehind) {
  struct Case {
    std::string target;
    std::string body;
    std::string type;
    int status;
    std::string code;
  };
  const std::string form = "multipart/form-data; boundary=B";
  const std::vector<Case> cases = {
      {"/jobs", "hello", "image/tiff", 415, "not-a-raster"},
      {"/jobs", "", "image/tiff", 415, "not-a-raster"},
      {"/jobs", tiff_, "text/plain", 415, "unsupported-media-type"},
      {"/jobs?levels=99", tiff_, "image/tiff", 400, "invalid-parameter"},
      {"/jobs?levls=2", tiff_, "image/tiff", 400, "unknown-parameter"},
      {"/jobs?levels=1&levels=2", tiff_, "image/tiff", 400, "invalid-parameter"},
      {"/jobs", std::string(1001, 'I'), "image/tiff", 413, "body-too-large"},
      {"/jobs", "nonsense", form, 400, "invalid-multipart"},
      {"/jobs", tiff_, "multipart/form-data", 400, "invalid-multipart"},
      {"/jobs", "--B\r\nContent-Disposition: form-data; name=params\r\n\r\n{}\r\n--B--", form, 400,
       "invalid-multipart"},
      {"/jobs",
       "--B\r\nContent-Disposition: form-data; name=params\r\n\r\n{\r\n--B\r\nContent-Disposition: "
       "form-data; name=dem\r\n\r\n" +
           tiff_ + "\r\n--B--",
       form, 400, "invalid-json"},
  };
  for (const Case& one : cases) {
    const HttpResponse response = Post(one.target, one.body, one.type);
    EXPECT_EQ(response.status, one.status) << one.target << " " << one.body;
    EXPECT_EQ(CodeOf(response), one.code) << one.target << " " << one.body;
    EXPECT_EQ(FieldOf(response, "Content-Type"), "application/problem+json");
    EXPECT_EQ(FilesLeft(), 0U) << one.code;
  }
}

TEST_F(HandlersTest, AnswersAKeyWithTheJobItMade) {
  const std::vector<std::pair<std::string, std::string>> key = {{"idempotency-key", "\"k\""}};
  const HttpResponse first = Post("/jobs", tiff_, "image/tiff", key);
  const HttpResponse again = Post("/jobs", tiff_, "image/tiff", {{"idempotency-key", "k"}});
  EXPECT_EQ(again.status, 201);
  EXPECT_EQ(FieldOf(first, "Location"), FieldOf(again, "Location"));
  const HttpResponse other = Post("/jobs?levels=2", tiff_, "image/tiff", key);
  EXPECT_EQ(other.status, 422);
  EXPECT_EQ(CodeOf(other), "idempotency-key-reused");
}

TEST_F(HandlersTest, RefusesJobsOverTheQueue) {
  EXPECT_EQ(Post("/jobs", tiff_).status, 201);
  EXPECT_EQ(Post("/jobs", tiff_).status, 201);
  const HttpResponse full = Post("/jobs", tiff_);
  EXPECT_EQ(full.status, 503);
  EXPECT_EQ(CodeOf(full), "queue-full");
  EXPECT_FALSE(FieldOf(full, "Retry-After").empty());
}

TEST_F(HandlersTest, TakesNothingWhileItDrains) {
  EXPECT_EQ(Send("GET", "/readyz").status, 200);
  jobs_->Drain();
  EXPECT_EQ(CodeOf(Post("/jobs", tiff_)), "draining");
  EXPECT_EQ(Send("GET", "/readyz").status, 503);
  EXPECT_EQ(Send("GET", "/healthz").status, 200);
}

TEST_F(HandlersTest, HasNoResultsBeforeTheEnd) {
  const std::string path = "/jobs/" + json::parse(Post("/jobs", tiff_).body).value("jobID", "");
  const HttpResponse early = Send("GET", path + "/results");
  EXPECT_EQ(early.status, 404);
  EXPECT_EQ(json::parse(early.body)["type"],
            "http://www.opengis.net/def/exceptions/ogcapi-processes-1/1.0/result-not-ready");
  const HttpResponse dismissed = Send("DELETE", path);
  EXPECT_EQ(dismissed.status, 200);
  EXPECT_EQ(json::parse(dismissed.body)["status"], "dismissed");
  EXPECT_EQ(CodeOf(Send("GET", path + "/results")), "result-not-available");
  EXPECT_EQ(Send("DELETE", path).status, 200);
  EXPECT_EQ(Send("GET", path).status, 404);
  EXPECT_EQ(FilesLeft(), 0U);
}

TEST_F(HandlersTest, KnowsNoJobByAnyOtherName) {
  for (const char* id : {"x", "..%2f..%2fetc", "%00", "0190f1e2-0000-7000-8000-000000000000"}) {
    EXPECT_EQ(Send("GET", std::string("/jobs/") + id).status, 404) << id;
  }
}

TEST_F(HandlersTest, PagesByLinks) {
  Post("/jobs", tiff_);
  Post("/jobs", tiff_);
  json page = json::parse(Send("GET", "/jobs?limit=1").body);
  EXPECT_EQ(page["jobs"].size(), 1U);
  ASSERT_EQ(page["links"].size(), 2U);
  EXPECT_EQ(page["links"][1]["rel"], "next");
  const std::string next = page["links"][1].value("href", "").substr(8);
  EXPECT_EQ(json::parse(Send("GET", next).body)["links"].size(), 1U);
  for (const char* query :
       {"limit=0", "limit=10001", "limit=a", "status=done", "x=1", "cursor=1"}) {
    EXPECT_EQ(CodeOf(Send("GET", std::string("/jobs?") + query)), "invalid-query-parameter-value")
        << query;
  }
}

TEST_F(HandlersTest, TellsTheMethodsThatThereAre) {
  const HttpResponse wrong = Send("PUT", "/jobs");
  EXPECT_EQ(wrong.status, 405);
  EXPECT_EQ(FieldOf(wrong, "Allow"), "POST, GET, HEAD, OPTIONS");
  EXPECT_EQ(Send("OPTIONS", "/jobs").status, 204);
  EXPECT_EQ(Send("GET", "/nothing").status, 404);
}

TEST_F(HandlersTest, AnswersWhatOpenapiSays) {
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

TEST_F(HandlersTest, AnswersInTheShapesOfTheSchemas) {
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

TEST(ClientJson, IsBoundedInDepthAndStrictInNames) {
  EXPECT_TRUE(ParseClientJson(R"({"a": [1, {"b": 2}], "c": {"b": 1}})"));
  EXPECT_FALSE(ParseClientJson(std::string(100'000, '[')));
  EXPECT_FALSE(ParseClientJson(std::string(100, '[') + std::string(100, ']')));
  EXPECT_FALSE(ParseClientJson(R"({"a": 1, "a": 2})"));
  EXPECT_FALSE(ParseClientJson("{\"a\": NaN}"));
  EXPECT_FALSE(ParseClientJson("\xFF"));
  EXPECT_FALSE(ParseClientJson(""));
}

TEST(RasterSniff, KnowsTheFormatsThatAreRead) {
  EXPECT_TRUE(LooksLikeRaster(std::string("MM\0*", 4), 100, "a"));
  EXPECT_TRUE(LooksLikeRaster("ncols 3\nnrows 3\n", 100, "a"));
  EXPECT_TRUE(LooksLikeRaster("UHL1", 100, "a"));
  EXPECT_TRUE(LooksLikeRaster(
      "VOL1" + std::string(76, ' ') + "HDR1" + std::string(76, ' ') + "UHL1", 1000, "a"));
  EXPECT_TRUE(LooksLikeRaster("", 2 * 1201 * 1201, "N46E007.hgt"));
  EXPECT_FALSE(LooksLikeRaster("", 2 * 1201 * 1201, "dem"));
  EXPECT_FALSE(LooksLikeRaster("", 100, "N46E007.hgt"));
  EXPECT_FALSE(LooksLikeRaster("<VRTDataset>", 100, "a.tif"));
  EXPECT_FALSE(LooksLikeRaster("VOL1", 4, "a"));
}

}  // namespace
}  // namespace farhorizon
