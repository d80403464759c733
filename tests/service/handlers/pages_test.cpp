#include "service/handlers/pages.h"

#include <filesystem>
#include <regex>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "service/pages/pages.h"
#include "tests/support/handlers_fixture.h"

namespace farhorizon {
namespace {

using nlohmann::json;
using testing::HasSubstr;
using testing::Not;

const std::pair<std::string, std::string> kBrowser = {
    "accept",
    "text/html,application/xhtml+xml,application/xml;q=0.9,image/avif,*/*;q=0.8,"
    "application/signed-exchange;v=b3;q=0.7"};

class PagesTest : public HandlersTest {
 protected:
  std::string NewJob() { return json::parse(Post("/jobs", tiff_).body).value("jobID", ""); }
  // With a folder of CesiumJS, of which one file is there in gzip, too.
  void InstallCesium() {
    const std::filesystem::path cesium = folder_ / "cesium";
    std::filesystem::create_directories(cesium / "Workers");
    SpillFile(cesium / "Cesium.js", "main");
    SpillFile(cesium / "Cesium.js.gz", "packed");
    SpillFile(cesium / "Workers" / "decode.js", std::string(100'000, 'w'));
    SpillFile(folder_ / "secret", "secret");
    auto read = std::make_shared<const AssetFolder>(*AssetFolder::Read(cesium));
    assets_ = "/assets/" + read->fingerprint() + "/";
    router_ = std::make_unique<Router>(BuildRouter({*jobs_, "http://x", 1000, {}, read}));
  }
  static std::string BytesOf(const HttpResponse& response) {
    std::string bytes;
    while (response.file && static_cast<std::int64_t>(bytes.size()) < response.file->bytes) {
      const std::int64_t at = static_cast<std::int64_t>(bytes.size());
      const auto piece = response.file->source->Read(at, response.file->bytes - at);
      if (!piece) break;
      bytes += *piece;
    }
    return bytes;
  }

  std::string assets_;
};

TEST_F(PagesTest, ShowsThePageToBrowsersAndLinksToPrograms) {
  const HttpResponse page = Send("GET", "/", {kBrowser});
  EXPECT_EQ(page.status, 200);
  EXPECT_EQ(FieldOf(page, "Content-Type"), "text/html; charset=utf-8");
  EXPECT_EQ(FieldOf(page, "Vary"), "Accept");
  EXPECT_THAT(page.body, HasSubstr("<!DOCTYPE html>"));
  for (const char* accept : {"*/*", "application/json", "text/html;q=0.5, application/json"}) {
    const HttpResponse links = Send("GET", "/", {{"accept", accept}});
    EXPECT_EQ(FieldOf(links, "Content-Type"), "application/json") << accept;
    EXPECT_EQ(json::parse(links.body)["links"][2]["href"], "http://x/jobs");
  }
  EXPECT_EQ(Send("GET", "/", {kBrowser, {"if-none-match", FieldOf(page, "ETag")}}).status, 304);
}

TEST_F(PagesTest, LetPagesAskTheServiceAlone) {
  const std::string id = NewJob();
  for (const std::string& path : {std::string("/"), "/viewer/" + id}) {
    const HttpResponse page = Send("GET", path, {kBrowser});
    const std::string policy = FieldOf(page, "Content-Security-Policy");
    EXPECT_THAT(policy, HasSubstr("default-src 'none'; script-src 'self'")) << path;
    EXPECT_THAT(policy, HasSubstr("frame-ancestors 'none'")) << path;
    EXPECT_THAT(policy, Not(HasSubstr("'unsafe-eval'"))) << path;
    EXPECT_THAT(policy, Not(HasSubstr("http"))) << path;
    // Nothing is within the page that such a policy forbids, and nothing comes from outside.
    const std::string body = std::regex_replace(page.body, std::regex("xmlns='[^']*'"), "");
    EXPECT_FALSE(std::regex_search(body, std::regex("<script>|<style|\\son[a-z]+=|https?://")))
        << body;
  }
}

TEST_F(PagesTest, HasAllThatThePagesName) {
  const std::string id = NewJob();
  int count = 0;
  for (const std::string& path : {std::string("/"), "/viewer/" + id}) {
    const std::string page = Send("GET", path, {kBrowser}).body;
    const std::regex part("(?:src|href)=\"(?:\\.\\./)?(assets/[^\"]+)\"");
    for (std::sregex_iterator at(page.begin(), page.end(), part), end; at != end; ++at) {
      const HttpResponse asset = Send("GET", "/" + (*at)[1].str());
      EXPECT_EQ(asset.status, 200) << (*at)[1];
      EXPECT_THAT(FieldOf(asset, "Content-Type"), HasSubstr("charset=utf-8"));
      EXPECT_THAT(FieldOf(asset, "Cache-Control"), HasSubstr("immutable"));
      EXPECT_FALSE(asset.body.empty());
      ++count;
    }
  }
  EXPECT_GE(count, 9);
}

TEST_F(PagesTest, ShowsAViewerForJobsThatThereAre) {
  const std::string id = NewJob();
  const HttpResponse page = Send("GET", "/viewer/" + id, {kBrowser});
  EXPECT_THAT(page.body, HasSubstr("data-results=\"../jobs/" + id + "/results/\""));
  EXPECT_THAT(page.body, HasSubstr("data-cesium=\"\""));
  EXPECT_EQ(CodeOf(Send("GET", "/viewer/%22%3E%3Cscript%3E")), "no-such-job");
  InstallCesium();
  EXPECT_THAT(Send("GET", "/viewer/" + id, {kBrowser}).body,
              HasSubstr("data-cesium=\".." + assets_.substr(0, assets_.size() - 1) + "\""));
}

TEST_F(PagesTest, SaysToPeopleThatThereIsNoSuchJob) {
  for (const std::string id :
       {"0190f1e2-0000-7000-8000-000000000000", "%22%3E%3Cscript%3Ealert(1)"}) {
    const HttpResponse page = Send("GET", "/viewer/" + id, {kBrowser});
    EXPECT_EQ(page.status, 404) << id;
    EXPECT_EQ(FieldOf(page, "Content-Type"), "text/html; charset=utf-8");
    EXPECT_THAT(page.body, HasSubstr("<h1>No such job</h1>"));
    EXPECT_THAT(page.body, HasSubstr("<a href=\"../\">All jobs</a>"));
    EXPECT_THAT(page.body, Not(HasSubstr("<script>")));
    EXPECT_THAT(FieldOf(page, "Content-Security-Policy"), HasSubstr("default-src 'none'"));
  }
}

TEST_F(PagesTest, SendsTheFilesOfCesiumJs) {
  InstallCesium();
  const HttpResponse worker = Send("GET", assets_ + "Workers/decode.js");
  EXPECT_EQ(BytesOf(worker), std::string(100'000, 'w'));
  EXPECT_EQ(FieldOf(worker, "Content-Type"), "text/javascript; charset=utf-8");
  EXPECT_THAT(FieldOf(worker, "Cache-Control"), HasSubstr("immutable"));
  EXPECT_EQ(FieldOf(worker, "Content-Encoding"), "");
  const std::string etag = FieldOf(worker, "ETag");
  EXPECT_EQ(Send("GET", assets_ + "Workers/decode.js", {{"if-none-match", etag}}).status, 304);
  const HttpResponse packed = Send("GET", assets_ + "Cesium.js", {{"accept-encoding", "gzip"}});
  EXPECT_EQ(BytesOf(packed), "packed");
  EXPECT_EQ(FieldOf(packed, "Content-Encoding"), "gzip");
  EXPECT_EQ(FieldOf(packed, "Content-Type"), "text/javascript; charset=utf-8");
  const HttpResponse plain = Send("GET", assets_ + "Cesium.js");
  EXPECT_EQ(BytesOf(plain), "main");
  EXPECT_NE(FieldOf(plain, "ETag"), FieldOf(packed, "ETag"));
}

TEST_F(PagesTest, LeadsNowhereOutOfTheFolder) {
  InstallCesium();
  for (const char* name :
       {"../secret", "..%2Fsecret", "%2e%2e/secret", "Workers/../../secret",
        "Workers%2f..%2f..%2fsecret", "/etc/passwd", "%2Fetc%2Fpasswd", "..\\secret",
        "Cesium.js%00.png", "Workers", "Workers/", ".", "none.js"}) {
    EXPECT_EQ(Send("GET", assets_ + name).status, 404) << name;
  }
  EXPECT_EQ(Send("GET", "/assets/0000000000000000/Cesium.js").status, 404);
  EXPECT_EQ(Send("GET", "/assets/" + PageFingerprint() + "/Cesium.js").status, 404);
  EXPECT_EQ(Send("GET", assets_ + "viewer.js").status, 404);
  EXPECT_EQ(Send("GET", "/assets/x").status, 404);
}

TEST_F(PagesTest, SendsNoFileThatHasChanged) {
  InstallCesium();
  SpillFile(folder_ / "cesium" / "Cesium.js", "another");
  EXPECT_EQ(Send("GET", assets_ + "Cesium.js").status, 404);
}

}  // namespace
}  // namespace farhorizon
