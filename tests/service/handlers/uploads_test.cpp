#include "service/handlers/uploads.h"

#include <functional>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "service/handlers/http_message.h"
#include "tests/support/handlers_fixture.h"

namespace farhorizon {
namespace {

using nlohmann::json;
using testing::HasSubstr;

using Fields = std::vector<std::pair<std::string, std::string>>;

constexpr const char* kSha1OfHello = "sha1 qvTGHdzF6KLavt4PO0gs2a6pQ00=";

class UploadsTest : public HandlersTest {
 protected:
  void SetUp() override {
    jobs_options_.uploads.bounds.each = 1000;
    jobs_options_.uploads.bounds.of_client = 5;
    HandlersTest::SetUp();
  }
  HttpResponse Tus(const std::string& method, const std::string& target, Fields fields = {},
                   const std::string& body = "") {
    fields.emplace_back("tus-resumable", "1.0.0");
    return Send(method, target, std::move(fields), body);
  }
  // The path of a new upload.
  std::string Make(const std::string& length, Fields fields = {}) {
    fields.emplace_back("upload-length", length);
    const HttpResponse made = Tus("POST", "/uploads", std::move(fields));
    EXPECT_EQ(made.status, 201) << made.body;
    const std::string location = FieldOf(made, "Location");
    EXPECT_THAT(location, HasSubstr("http://x/uploads/"));
    return location.substr(std::string("http://x").size());
  }
  HttpResponse Patch(const std::string& path, const std::string& offset, const std::string& body,
                     Fields fields = {}) {
    fields.emplace_back("upload-offset", offset);
    fields.emplace_back("content-type", "application/offset+octet-stream");
    return Tus("PATCH", path, std::move(fields), body);
  }
  std::string OffsetOf(const std::string& path) {
    return FieldOf(Tus("HEAD", path), "Upload-Offset");
  }
  HttpResponse PostJob(const std::string& href, json more = json::object()) {
    json inputs = {{"dem", {{"href", href}}}};
    inputs.update(more);
    return Post("/jobs", json{{"inputs", inputs}}.dump(), "application/json");
  }
};

TEST_F(UploadsTest, TakesADemInPiecesAndMakesAJobOfIt) {
  // "a/b.tif" and "image/tiff".
  const std::string metadata = "filename YS9iLnRpZg==,filetype aW1hZ2UvdGlmZg==,other";
  const std::string path = Make("8", {{"upload-metadata", metadata}});
  HttpResponse answer = Patch(path, "0", tiff_.substr(0, 5));
  EXPECT_EQ(answer.status, 204);
  EXPECT_EQ(FieldOf(answer, "Upload-Offset"), "5");
  EXPECT_THAT(FieldOf(answer, "Upload-Expires"), HasSubstr("GMT"));
  const HttpResponse head = Tus("HEAD", path);
  EXPECT_EQ(head.status, 200);
  EXPECT_EQ(FieldOf(head, "Upload-Offset"), "5");
  EXPECT_EQ(FieldOf(head, "Upload-Length"), "8");
  EXPECT_EQ(FieldOf(head, "Upload-Metadata"), metadata);
  EXPECT_EQ(FieldOf(head, "Cache-Control"), "no-store");
  EXPECT_EQ(CodeOf(PostJob(path)), "upload-incomplete");
  EXPECT_EQ(PostJob(path).status, 409);
  answer = Patch(path, "5", tiff_.substr(5));
  EXPECT_EQ(FieldOf(answer, "Upload-Offset"), "8");
  const json info = json::parse(Send("GET", path).body);
  EXPECT_EQ(info["complete"], true);
  EXPECT_EQ(info["length"], 8);
  EXPECT_EQ(info["filename"], "b.tif");
  EXPECT_EQ(info["filetype"], "image/tiff");

  const HttpResponse made = PostJob("http://x" + path, {{"levels", 2}});
  ASSERT_EQ(made.status, 201) << made.body;
  const Job job = *jobs_->Find(made.job_id);
  EXPECT_EQ(job.filename, "b.tif");
  EXPECT_EQ(job.input_sha256, (*jobs_->Find(Post("/jobs", tiff_).job_id)).input_sha256);
  EXPECT_EQ(job.parameters, (Parameters{{"levels", "2"}}));
}

TEST_F(UploadsTest, AJobOfAnUploadIsTheSameJobForAnIdempotencyKey) {
  const std::string path = Make("8");
  Patch(path, "0", tiff_);
  const auto post = [&](const std::string& href, const std::string& name) {
    const json body = {{"inputs", {{"dem", {{"href", href}}}, {"filename", name}}}};
    return Post("/jobs", body.dump(), "application/json", {{"idempotency-key", "k"}});
  };
  const HttpResponse first = post(path, "a.tif");
  EXPECT_EQ(post("http://x" + path, "a.tif").job_id, first.job_id);
  const std::string other = Make("8");
  Patch(other, "0", tiff_);
  EXPECT_EQ(post(other, "a.tif").job_id, first.job_id) << "the bytes count, not where they are";
  EXPECT_EQ(CodeOf(post(path, "b.tif")), "idempotency-key-reused");
  const std::string another = Make("8");
  Patch(another, "0", std::string("II*\0oth.", 8));
  EXPECT_EQ(CodeOf(post(another, "a.tif")), "idempotency-key-reused");
}

TEST_F(UploadsTest, LinksOfJobsAreToldApart) {
  const std::string path = Make("8");
  Patch(path, "0", tiff_);
  const std::string id = path.substr(path.rfind('/') + 1);
  for (const std::string& href :
       {std::string("http://evil.example") + path, std::string("//x") + path,
        "http://x.evil" + path, path + "/", path + "?x", path + "#x", "/uploads/../uploads/" + id,
        std::string("/uploads/"), std::string(), "http://u@x" + path, "/uploads/%" + id,
        std::string("file:///etc/passwd")}) {
    const HttpResponse answer = PostJob(href);
    EXPECT_EQ(answer.status, 403) << href << answer.body;
    EXPECT_EQ(CodeOf(answer), "href-not-allowed") << href;
  }
  const auto dem = [&](const json& given) {
    return CodeOf(Post("/jobs", json{{"inputs", {{"dem", given}}}}.dump(), "application/json"));
  };
  EXPECT_EQ(dem({{"href", 5}}), "invalid-parameter");
  EXPECT_EQ(dem({{"href", path}, {"value", "AAAA"}}), "invalid-parameter");
  EXPECT_EQ(dem({{"href", path}, {"type", "text/html"}}), "unsupported-media-type");
  EXPECT_EQ(dem({{"href", "/uploads/01900000-0000-7000-8000-000000000001"}}), "no-such-upload");
  EXPECT_EQ(dem(json::array({{{"href", path}}})), "invalid-parameter");
  // By the name that the request itself came by.
  const json body = {{"inputs", {{"dem", {{"href", "http://localhost:1" + path}}}}}};
  EXPECT_EQ(Post("/jobs", body.dump(), "application/json", {{"host", "localhost:1"}}).status, 201);
}

TEST_F(UploadsTest, SaysWhatItKnowsToOptions) {
  for (const char* target : {"/uploads", "/uploads/x"}) {
    const HttpResponse answer = Send("OPTIONS", target);
    EXPECT_EQ(answer.status, 204);
    EXPECT_EQ(FieldOf(answer, "Tus-Version"), "1.0.0");
    EXPECT_EQ(FieldOf(answer, "Tus-Max-Size"), "1000");
    EXPECT_EQ(FieldOf(answer, "Tus-Checksum-Algorithm"), "sha1,sha256");
    EXPECT_THAT(FieldOf(answer, "Tus-Extension"), HasSubstr("creation-with-upload"));
    EXPECT_THAT(FieldOf(answer, "Access-Control-Allow-Headers"), HasSubstr("Upload-Offset"));
  }
  EXPECT_THAT(FieldOf(Send("OPTIONS", "/uploads/x"), "Access-Control-Allow-Methods"),
              HasSubstr("PATCH"));
  const HttpResponse wrong = Send("PUT", "/uploads/x");
  EXPECT_EQ(wrong.status, 405);
  EXPECT_EQ(FieldOf(wrong, "Allow"), "PATCH, GET, HEAD, DELETE, OPTIONS");
}

TEST_F(UploadsTest, RefusesOtherVersionsWithTheOneThatIsSpoken) {
  const std::string path = Make("8");
  for (const char* method : {"POST", "HEAD", "PATCH", "DELETE"}) {
    const std::string target = std::string(method) == "POST" ? "/uploads" : path;
    for (const Fields& fields : {Fields{}, Fields{{"tus-resumable", "0.2.2"}}}) {
      const HttpResponse answer = Send(method, target, fields);
      EXPECT_EQ(answer.status, 412) << method;
      EXPECT_EQ(FieldOf(answer, "Tus-Version"), "1.0.0");
    }
  }
  EXPECT_EQ(Send("GET", path).status, 200) << "for people";
}

TEST_F(UploadsTest, RefusesHeadsThatCannotBe) {
  const std::string long_metadata(5000, 'a');
  const std::vector<std::pair<Fields, int>> cases = {
      {{}, 400},
      {{{"upload-length", ""}}, 400},
      {{{"upload-length", "-1"}}, 400},
      {{{"upload-length", "0x10"}}, 400},
      {{{"upload-length", "1.5"}}, 400},
      {{{"upload-length", "18446744073709551617"}}, 413},
      {{{"upload-length", "99999999999999999999999999"}}, 413},
      {{{"upload-length", "1001"}}, 413},
      {{{"upload-length", "5"}, {"upload-defer-length", "1"}}, 400},
      {{{"upload-defer-length", "2"}}, 400},
      {{{"upload-length", "5"}, {"upload-metadata", "filename ???"}}, 400},
      {{{"upload-length", "5"}, {"upload-metadata", "filename QQ=A"}}, 400},
      {{{"upload-length", "5"}, {"upload-metadata", "filename QQ== QQ=="}}, 400},
      {{{"upload-length", "5"}, {"upload-metadata", "a QQ==,a QQ=="}}, 400},
      {{{"upload-length", "5"}, {"upload-metadata", ",a"}}, 400},
      {{{"upload-length", "5"}, {"upload-metadata", "filename AA=="}}, 400},  // NUL
      {{{"upload-length", "5"}, {"upload-metadata", long_metadata}}, 400},
      {{{"upload-length", "5"}, {"upload-checksum", "md5 XUFAKrxLKna5cZ2REBfFkg=="}}, 400},
      {{{"upload-length", "5"}, {"upload-checksum", "sha1 AAAA"}}, 400},
      {{{"upload-length", "5"}, {"upload-checksum", "sha1"}}, 400},
  };
  for (const auto& [fields, status] : cases) {
    const HttpResponse answer = Tus("POST", "/uploads", fields);
    const std::string shown = fields.empty() ? "" : fields.back().second.substr(0, 60);
    EXPECT_EQ(answer.status, status) << shown << " " << answer.body;
    EXPECT_EQ(CodeOf(answer), status == 400 ? "invalid-upload" : "body-too-large") << shown;
  }
  EXPECT_EQ(jobs_->Uploads().Count()->uploads, 0);
}

TEST_F(UploadsTest, RefusesPiecesThatDoNotFit) {
  const std::string path = Make("8");
  ASSERT_EQ(Patch(path, "0", "abc").status, 204);
  EXPECT_EQ(Patch(path, "0", "abc").status, 409);
  EXPECT_EQ(Patch(path, "4", "abc").status, 409);
  EXPECT_EQ(Patch(path, "18446744073709551619", "abc").status, 409);
  EXPECT_EQ(CodeOf(Patch(path, "-3", "abc")), "invalid-upload");
  EXPECT_EQ(CodeOf(Tus("PATCH", path, {{"content-type", "application/offset+octet-stream"}}, "x")),
            "invalid-upload")
      << "no offset";
  EXPECT_EQ(Patch(path, "3", "abcdef").status, 413) << "beyond the length";
  EXPECT_EQ(Patch(path, "3", "abc", {{"upload-length", "9"}}).status, 400);
  EXPECT_EQ(Patch(path, "3", "abc", {{"content-encoding", "gzip"}}).status, 415);
  for (const char* type : {"application/octet-stream", "image/tiff", ""}) {
    const Fields fields = {{"content-type", type}, {"upload-offset", "3"}};
    EXPECT_EQ(Tus("PATCH", path, fields, "abc").status, 415) << type;
  }
  EXPECT_EQ(OffsetOf(path), "3");
  for (const char* id : {"x", "01900000-0000-7000-8000-000000000001", "..%2F..", "%00", "A'--"}) {
    EXPECT_EQ(CodeOf(Patch(std::string("/uploads/") + id, "0", "abc")), "no-such-upload") << id;
  }
}

TEST_F(UploadsTest, KeepsNothingOfABodyWithAnotherChecksum) {
  const std::string path = Make("8");
  const Fields sum = {{"upload-checksum", kSha1OfHello}};
  const HttpResponse wrong = Patch(path, "0", "hellO", sum);
  EXPECT_EQ(wrong.status, 460);
  EXPECT_EQ(CodeOf(wrong), "checksum-mismatch");
  EXPECT_EQ(OffsetOf(path), "0");
  EXPECT_EQ(FilesLeft(), 0U);
  EXPECT_EQ(Patch(path, "0", "hello", sum).status, 204);
  EXPECT_EQ(OffsetOf(path), "5");
  const Fields other = {{"upload-checksum", "sha256 ungWv48Bz+pBQUDeXa4iI7ADYaOWF3qctBD/YfIAFa0="}};
  EXPECT_EQ(Patch(path, "5", "abc", other).status, 204) << "sha256 of abc";
}

TEST_F(UploadsTest, IsMadeWithItsFirstBytes) {
  const Fields fields = {{"upload-length", "8"},
                         {"content-type", "application/offset+octet-stream"}};
  const HttpResponse made = Tus("POST", "/uploads", fields, "abc");
  EXPECT_EQ(made.status, 201);
  EXPECT_EQ(FieldOf(made, "Upload-Offset"), "3");
  EXPECT_EQ(OffsetOf(FieldOf(made, "Location").substr(8)), "3");
  EXPECT_EQ(Tus("POST", "/uploads", fields, "abcdefghi").status, 413);
  EXPECT_EQ(Tus("POST", "/uploads", {{"upload-length", "8"}}, "abc").status, 415);
  Fields wrong = fields;
  wrong.emplace_back("upload-checksum", kSha1OfHello);
  EXPECT_EQ(Tus("POST", "/uploads", wrong, "abc").status, 460);
  EXPECT_EQ(jobs_->Uploads().Count()->uploads, 1) << "what nobody has a URL of is gone";
}

TEST_F(UploadsTest, LearnsItsLengthWithALaterRequest) {
  const HttpResponse made = Tus("POST", "/uploads", {{"upload-defer-length", "1"}});
  ASSERT_EQ(made.status, 201);
  const std::string path = FieldOf(made, "Location").substr(8);
  EXPECT_EQ(FieldOf(Tus("HEAD", path), "Upload-Defer-Length"), "1");
  EXPECT_EQ(Patch(path, "0", std::string("II*\0", 4)).status, 204);
  EXPECT_EQ(CodeOf(PostJob(path)), "upload-incomplete");
  EXPECT_EQ(Patch(path, "4", std::string(997, 'x')).status, 413);
  EXPECT_EQ(Patch(path, "4", "....", {{"upload-length", "3"}}).status, 413);
  EXPECT_EQ(Patch(path, "4", "....", {{"upload-length", "1001"}}).status, 413);
  EXPECT_EQ(Patch(path, "4", "....", {{"upload-length", "8"}}).status, 204);
  EXPECT_EQ(FieldOf(Tus("HEAD", path), "Upload-Length"), "8");
  EXPECT_EQ(PostJob(path).status, 201);
}

TEST_F(UploadsTest, EndsWhenItsClientSaysSo) {
  const std::string path = Make("8");
  Patch(path, "0", "abc");
  EXPECT_EQ(Tus("DELETE", path).status, 204);
  EXPECT_EQ(Tus("HEAD", path).status, 404);
  EXPECT_EQ(FieldOf(Tus("HEAD", path), "Upload-Offset"), "");
  EXPECT_EQ(Patch(path, "3", "abc").status, 404);
  EXPECT_EQ(Tus("DELETE", path).status, 404);
}

TEST_F(UploadsTest, TakesPatchAndDeleteByPost) {
  const std::string path = Make("8");
  const Fields fields = {{"x-http-method-override", "PATCH"},
                         {"upload-offset", "0"},
                         {"content-type", "application/offset+octet-stream"}};
  EXPECT_EQ(Tus("POST", path, fields, "abc").status, 204);
  EXPECT_EQ(OffsetOf(path), "3");
  EXPECT_EQ(Tus("POST", path).status, 405);
  EXPECT_EQ(Tus("POST", path, {{"x-http-method-override", "DELETE"}}).status, 204);
  EXPECT_EQ(Tus("POST", "/uploads", {{"x-http-method-override", "DELETE"}}).status, 400)
      << "it is a POST";
}

TEST_F(UploadsTest, HasABoundForEachClient) {
  for (int i = 0; i < 5; ++i) Make("8");
  const HttpResponse full = Tus("POST", "/uploads", {{"upload-length", "8"}});
  EXPECT_EQ(full.status, 429);
  EXPECT_EQ(CodeOf(full), "too-many-uploads");
  EXPECT_EQ(FieldOf(full, "Retry-After"), "5");
}

TEST_F(UploadsTest, RefusesNewBytesWhileTheServiceDrains) {
  const std::string path = Make("8");
  jobs_->Drain();
  EXPECT_EQ(Patch(path, "0", "abc").status, 503);
  EXPECT_EQ(Tus("POST", "/uploads", {{"upload-length", "8"}}).status, 503);
  EXPECT_EQ(Tus("HEAD", path).status, 200);
}

TEST_F(UploadsTest, AnEmptyUploadIsWholeAndNoRaster) {
  const std::string path = Make("0");
  EXPECT_EQ(json::parse(Send("GET", path).body)["complete"], true);
  EXPECT_EQ(PostJob(path).status, 415);
}

}  // namespace
}  // namespace farhorizon
