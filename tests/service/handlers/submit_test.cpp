#include "service/handlers/submit.h"

#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "tests/support/handlers_fixture.h"

namespace farhorizon {
namespace {

using nlohmann::json;

using SubmitTest = HandlersTest;

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
