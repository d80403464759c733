#include "service/handlers/submit.h"

#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "tests/support/handlers_fixture.h"

namespace farhorizon {
namespace {

using nlohmann::json;

using SubmitTest = HandlersTest;
using testing::HasSubstr;

constexpr const char* kForm = "multipart/form-data; boundary=B";

/// A form, from its first boundary on, with a DEM of this name.
std::string FormOf(const std::string& filename, const std::string& dem) {
  return "--B\r\nContent-Disposition: form-data; name=\"dem\"; filename=\"" + filename +
         "\"\r\n\r\n" + dem + "\r\n--B--\r\n";
}

std::string DetailOf(const HttpResponse& response) {
  return json::parse(response.body).value("detail", "");
}

TEST_F(SubmitTest, AcceptsATiff) {
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

TEST_F(SubmitTest, AcceptsAForm) {
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

TEST_F(SubmitTest, RefusalsSayWhyAndLeaveNothingBehind) {
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
      {"/jobs", tiff_, "text/html", 415, "unsupported-media-type"},
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

TEST_F(SubmitTest, RefusesABodyThatIsEncoded) {
  const HttpResponse body = Post("/jobs", tiff_, "image/tiff", {{"content-encoding", "gzip"}});
  EXPECT_EQ(body.status, 415);
  EXPECT_EQ(FieldOf(body, "Accept-Encoding"), "identity");
  const std::string part = FormOf("a.tif\"\r\nContent-Transfer-Encoding: base64\r\nX: \"", tiff_);
  const HttpResponse form = Post("/jobs", part, kForm);
  EXPECT_EQ(form.status, 415) << form.body;
  EXPECT_THAT(DetailOf(form), testing::AllOf(HasSubstr("base64"), HasSubstr("'dem'")));
  EXPECT_EQ(FilesLeft(), 0U);
}

TEST_F(SubmitTest, TakesADemWithoutAContentType) {
  EXPECT_EQ(Send("POST", "/jobs", {}, tiff_).status, 201);
}

TEST_F(SubmitTest, TakesFileNamesAsBrowsersSendThem) {
  const auto name = [&](const std::string& filename) {
    const HttpResponse response = Post("/jobs", FormOf(filename, std::string(tiff_)), kForm);
    const std::string id = json::parse(response.body).value("jobID", "");
    Send("DELETE", "/jobs/" + id);  // makes room for the next
    return json::parse(response.body).value("filename", "");
  };
  EXPECT_EQ(name(R"(C:\fakepath\N38E007.HGT)"), "N38E007.HGT");
  EXPECT_EQ(name(R"(C:\dem\new\n38e007.hgt)"), "n38e007.hgt");
  EXPECT_EQ(name("a%22b.tif"), "ab.tif");
  EXPECT_EQ(name("H\xC3\xB6he.asc"), "Hhe.asc");
  const std::string renamed =
      "--B\r\nContent-Disposition: form-data; name=params\r\n\r\n{\"filename\": "
      "\"N38E007.hgt\"}\r\n" +
      FormOf("blob", tiff_);
  const HttpResponse form = Post("/jobs", renamed, kForm);
  EXPECT_EQ(json::parse(form.body)["filename"], "N38E007.hgt");
  EXPECT_EQ(CodeOf(Post("/jobs?filename=a.tif", renamed, kForm)), "invalid-parameter");
  const HttpResponse query = Post("/jobs?filename=C:%5Cdem%5CMy+DEM.tif", tiff_);
  EXPECT_EQ(json::parse(query.body)["filename"], "MyDEM.tif");
}

TEST_F(SubmitTest, SaysWhereTheNameGoesThatAFormatIsKnownBy) {
  EXPECT_THAT(DetailOf(Post("/jobs", "hello", "image/tiff")), HasSubstr("?filename=N46E007.hgt"));
  EXPECT_THAT(DetailOf(Post("/jobs?filename=a.tif", "hello", "image/tiff")),
              testing::Not(HasSubstr("?filename")));
}

TEST_F(SubmitTest, TakesNoDataAsAListInEachForm) {
  const auto nodata = [&](const HttpResponse& response) {
    const std::string id = json::parse(response.body).value("jobID", "");
    const auto job = jobs_->Find(id);
    if (!job) return response.body;
    Send("DELETE", "/jobs/" + id);
    return job->parameters.at("nodata");
  };
  EXPECT_EQ(nodata(Post("/jobs?nodata=-9999&nodata=-inf", tiff_)), "-9999,-inf");
  EXPECT_EQ(nodata(Post("/jobs?nodata=-9999,nan", tiff_)), "-9999,nan");
  EXPECT_EQ(nodata(Post("/jobs?nodata=-3.4e+38", tiff_)), "-3.4e+38");
  for (const char* list : {R"(["-inf", -9999])", R"("-inf,-9999")"}) {
    const std::string form =
        "--B\r\nContent-Disposition: form-data; name=params\r\n\r\n{\"nodata\": " +
        std::string(list) + "}\r\n" + FormOf("a.tif", tiff_);
    EXPECT_EQ(nodata(Post("/jobs", form, kForm)), "-inf,-9999") << list;
  }
}

TEST_F(SubmitTest, NamesTheParameterAndNotTheFlag) {
  for (const auto& [query, name] :
       std::vector<std::pair<std::string, std::string>>{{"maxError=-1", "maxError"},
                                                        {"heightUnit=yards", "heightUnit"},
                                                        {"nodata=none", "nodata"},
                                                        {"datumOperation=", "datumOperation"}}) {
    const HttpResponse response = Post("/jobs?" + query, tiff_);
    EXPECT_EQ(response.status, 400) << query;
    EXPECT_EQ(DetailOf(response).find(name + " is"), 0U) << DetailOf(response);
  }
}

TEST_F(SubmitTest, AnswersAKeyWithTheJobItMade) {
  const std::vector<std::pair<std::string, std::string>> key = {{"idempotency-key", "\"k\""}};
  const HttpResponse first = Post("/jobs", tiff_, "image/tiff", key);
  const HttpResponse again = Post("/jobs", tiff_, "image/tiff", {{"idempotency-key", "k"}});
  EXPECT_EQ(again.status, 201);
  EXPECT_EQ(FieldOf(first, "Location"), FieldOf(again, "Location"));
  const HttpResponse other = Post("/jobs?levels=2", tiff_, "image/tiff", key);
  EXPECT_EQ(other.status, 422);
  EXPECT_EQ(CodeOf(other), "idempotency-key-reused");
}

TEST_F(SubmitTest, RefusesJobsOverTheQueue) {
  EXPECT_EQ(Post("/jobs", tiff_).status, 201);
  EXPECT_EQ(Post("/jobs", tiff_).status, 201);
  const HttpResponse full = Post("/jobs", tiff_);
  EXPECT_EQ(full.status, 503);
  EXPECT_EQ(CodeOf(full), "queue-full");
  EXPECT_FALSE(FieldOf(full, "Retry-After").empty());
}

}  // namespace
}  // namespace farhorizon
