// The real program, on loopback: as its clients, its enemies and its operators meet it.
#include <algorithm>
#include <signal.h>
#include <sys/socket.h>
#include <thread>
#include <unistd.h>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "core/io/base64.h"
#include "core/io/sha256.h"
#include "tests/support/gunzip.h"
#include "tests/support/json_schema.h"
#include "tests/support/service_fixture.h"
#include "tests/support/unzstd.h"

namespace farhorizon {
namespace {

using nlohmann::json;

TEST_F(ServiceE2e, AJobLeavesTheBytesThatBuildLeaves) {
  SpillFile(folder_ / "small.asc", SmallGrid());
  const std::string dem = (folder_ / "small.asc").string();
  ASSERT_EQ(Run({"build", dem, "-o", (folder_ / "built").string(), "--crs", "EPSG:4326",
                 "--triangles", "700,300"}),
            0)
      << SlurpFile(folder_ / "stderr");
  Start();
  ASSERT_EQ(Run({"submit", dem, "--url", "http://127.0.0.1:" + std::to_string(port_), "-o",
                 (folder_ / "sent").string(), "--crs", "EPSG:4326", "--triangles", "700,300"}),
            0)
      << SlurpFile(folder_ / "stderr");
  // The grid says nothing of the unit of its heights. The service names the parameter that would,
  // the report the flag, so that it is the same.
  EXPECT_THAT(SlurpFile(folder_ / "stderr"),
              testing::AllOf(testing::HasSubstr("assumed: "), testing::HasSubstr("heightUnit")));
  EXPECT_THAT(SlurpFile(folder_ / "sent" / "report.json"), testing::HasSubstr("--height-unit"));
  std::size_t files = 0;
  for (const auto& entry : std::filesystem::directory_iterator(folder_ / "built")) {
    const std::string name = entry.path().filename().string();
    EXPECT_EQ(SlurpFile(entry.path()), SlurpFile(folder_ / "sent" / name)) << name;
    ++files;
  }
  EXPECT_GE(files, 8U);
  const std::string root = FARHORIZON_SOURCE_DIR;
  for (const auto& [file, schema] :
       std::vector<std::pair<std::string, std::string>>{{"report.json", "report"},
                                                        {"manifest.json", "manifest"},
                                                        {"horizon.geojson", "horizon"}}) {
    const json shape = json::parse(SlurpFile(root + "/proto/schemas/" + schema + ".schema.json"));
    EXPECT_THAT(SchemaOffences(json::parse(SlurpFile(folder_ / "built" / file)), shape),
                testing::IsEmpty())
        << file;
  }
  EXPECT_EQ(std::distance(std::filesystem::directory_iterator(folder_ / "sent"), {}),
            static_cast<std::ptrdiff_t>(files));
  EXPECT_EQ(LeftOver("spool") + LeftOver("work"), 0U);
}

TEST_F(ServiceE2e, AJobPastItsWorkBudgetFailsOrIsApproximate) {
  Start();
  const auto submit = [this](const std::string& parameters) {
    const RawAnswer answer = Ask(
        port_, "POST", "/jobs?crs=EPSG:4326&levels=1&filename=a.asc&workBudget=2000" + parameters,
        "Content-Type: application/octet-stream\r\n", SmallGrid());
    EXPECT_EQ(answer.status, 201) << answer.body;
    return "/jobs/" + json::parse(answer.body).value("jobID", "");
  };
  const std::string strict = submit("");
  EXPECT_EQ(WaitForEnd(strict), "failed");
  EXPECT_EQ(FailureOf(strict), "work-budget");
  EXPECT_EQ(Ask(port_, "GET", strict + "/results").status, 422);
  const std::string lenient = submit("&approximate=true");
  ASSERT_EQ(WaitForEnd(lenient), "successful");
  const json report = json::parse(Ask(port_, "GET", lenient + "/results/report.json").body);
  EXPECT_EQ(report["horizon"]["approximate"], true);
  EXPECT_GT(report["horizon"]["undecided"], 0);
  EXPECT_EQ(report["horizon"]["work_budget"], 2000);
}

TEST_F(ServiceE2e, BadInputIsRefusedBeforeTheJobAndLeavesNothing) {
  Start();
  const RawAnswer bare = Ask(port_, "POST", "/jobs?filename=a.asc",
                             "Content-Type: application/octet-stream\r\n", SmallGrid());
  EXPECT_EQ(bare.status, 422);
  EXPECT_EQ(json::parse(bare.body)["code"], "no-crs");
  const RawAnswer cut =
      Ask(port_, "POST", "/jobs", "Content-Type: image/tiff\r\n", std::string("II*\0garbage", 11));
  EXPECT_TRUE(cut.status == 415 || cut.status == 422) << cut.body;
  EXPECT_EQ(LeftOver("spool") + LeftOver("work"), 0U);
  EXPECT_TRUE(json::parse(Ask(port_, "GET", "/jobs").body)["jobs"].empty());
}

TEST_F(ServiceE2e, ShowsAPageUnderAPolicyThatShutsItIn) {
  Start();
  const std::string job = Submit("a.asc&levels=1");
  ASSERT_EQ(WaitForEnd(job), "successful");
  const json links = json::parse(Ask(port_, "GET", job + "/results").body);
  EXPECT_EQ(links["report.html"]["type"], "text/html");
  const std::string page = Ask(port_, "GET", job + "/results/report.html").head;
  EXPECT_THAT(page, testing::HasSubstr("Content-Type: text/html\r\n"));
  EXPECT_THAT(page, testing::HasSubstr("Content-Disposition: inline; filename=\"report.html\""));
  const std::string policy = "Content-Security-Policy: default-src 'none'";
  EXPECT_THAT(page, testing::HasSubstr(policy + "; img-src data:;"));
  EXPECT_THAT(page, testing::HasSubstr("sandbox allow-scripts\r\n"));
  EXPECT_EQ(page.find(policy), page.rfind(policy)) << "a browser would heed both";
  const std::string report = Ask(port_, "GET", job + "/results/report.json").head;
  EXPECT_THAT(report, testing::HasSubstr("Content-Disposition: attachment"));
  EXPECT_THAT(report, testing::HasSubstr(policy + "\r\n"));
}

TEST_F(ServiceE2e, AnswersExecuteRequestsAtOnceOrByAJob) {
  Start({"FARHORIZON_CONFORMANCE_ECHO=on"});
  const auto execute = [this](const std::string& process, const json& body) {
    return Ask(port_, "POST", "/processes/" + process + "/execution",
               "Content-Type: application/json\r\n", body.dump());
  };
  const RawAnswer echo = execute(
      "echo", {{"inputs", {{"text", "hi"}, {"numbers", {1, 2}}}}, {"response", "document"}});
  EXPECT_EQ(echo.status, 200) << echo.body;
  EXPECT_EQ(json::parse(echo.body), json::parse(R"({"numbers": [1, 2], "text": "hi"})"));
  EXPECT_EQ(echo.head.find("Link:"), std::string::npos);
  const std::string grid = SmallGrid();
  const std::string dem =
      ToBase64({reinterpret_cast<const unsigned char*>(grid.data()), grid.size()});
  const RawAnswer accepted =
      execute("terrain-lod", {{"inputs", {{"dem", dem}, {"crs", "EPSG:4326"}, {"levels", 1}}},
                              {"outputs", {{"lod0.glb", json::object()}}}});
  ASSERT_EQ(accepted.status, 201) << accepted.body;
  const std::string job = "/jobs/" + json::parse(accepted.body).value("jobID", "");
  ASSERT_EQ(WaitForEnd(job), "successful");
  const RawAnswer mesh = Ask(port_, "GET", job + "/results");
  EXPECT_EQ(mesh.status, 200);
  EXPECT_EQ(mesh.body.substr(0, 4), "glTF");
  EXPECT_EQ(mesh.body, Ask(port_, "GET", job + "/results/lod0.glb").body);
}

TEST_F(ServiceE2e, SendsInGzipWhatThatMakesSmaller) {
  Start();
  const std::string job = Submit("a.asc&levels=1");
  ASSERT_EQ(WaitForEnd(job), "successful");
  const std::string page = job + "/results/report.html";
  const RawAnswer plain = Ask(port_, "GET", page);
  EXPECT_EQ(plain.head.find("Content-Encoding"), std::string::npos);
  const RawAnswer small = Ask(port_, "GET", page, "Accept-Encoding: gzip, br\r\n");
  EXPECT_THAT(small.head, testing::HasSubstr("Content-Encoding: gzip\r\n"));
  for (const RawAnswer* both : {&plain, &small}) {
    EXPECT_THAT(both->head, testing::HasSubstr("Content-Type: text/html\r\n"));
    EXPECT_THAT(both->head, testing::HasSubstr("Vary: Accept-Encoding\r\n"));
    EXPECT_THAT(both->head, testing::HasSubstr("ETag: \"" + Sha256Hex(both->body) + "\"\r\n"))
        << "each form has a tag of its own";
  }
  EXPECT_LT(small.body.size(), plain.body.size());
  EXPECT_EQ(Gunzip(small.body), plain.body);
  // A download in gzip that was cut off goes on where it ended.
  const RawAnswer rest = Ask(port_, "GET", page,
                             "Accept-Encoding: gzip\r\nRange: bytes=100-\r\nIf-Range: \"" +
                                 Sha256Hex(small.body) + "\"\r\n");
  EXPECT_EQ(rest.status, 206);
  EXPECT_EQ(small.body.substr(0, 100) + rest.body, small.body);
  const RawAnswer mesh = Ask(port_, "GET", job + "/results/lod0.drc", "Accept-Encoding: gzip\r\n");
  EXPECT_EQ(mesh.head.find("Content-Encoding"), std::string::npos);
}

TEST_F(ServiceE2e, SendsInZstdWhatThatMakesSmallerStill) {
  StartStandIn();
  const std::string job = Submit("numbers.asc");
  ASSERT_EQ(WaitForEnd(job), "successful");
  const std::string numbers = job + "/results/report.json";
  const RawAnswer plain = Ask(port_, "GET", numbers);
  const RawAnswer gzip = Ask(port_, "GET", numbers, "Accept-Encoding: gzip\r\n");
  const RawAnswer zstd = Ask(port_, "GET", numbers, "Accept-Encoding: gzip, deflate, zstd\r\n");
  EXPECT_THAT(zstd.head, testing::HasSubstr("Content-Encoding: zstd\r\n"));
  EXPECT_THAT(zstd.head, testing::HasSubstr("Vary: Accept-Encoding\r\n"));
  EXPECT_THAT(zstd.head, testing::HasSubstr("ETag: \"" + Sha256Hex(zstd.body) + "\"\r\n"));
  EXPECT_LT(zstd.body.size(), gzip.body.size());
  EXPECT_EQ(Unzstd(zstd.body), plain.body);
  EXPECT_EQ(Ask(port_, "DELETE", job).status, 200);
}

// Their files are in gzip: a client that is not told so cannot read them.
TEST_F(ServiceE2e, SendsTilesOfTerrainInGzipWhateverIsAskedFor) {
  Start();
  const std::string job = Submit("a.asc&levels=1&formats=quantized-mesh");
  ASSERT_EQ(WaitForEnd(job), "successful");
  const std::string layer = Ask(port_, "GET", job + "/results/layer.json").body;
  EXPECT_EQ(nlohmann::json::parse(layer)["format"], "quantized-mesh-1.0");
  for (const char* asks : {"", "Accept-Encoding: gzip\r\n"}) {
    const RawAnswer tile = Ask(port_, "GET", job + "/results/terrain-0-0-0.terrain", asks);
    EXPECT_EQ(tile.status, 200);
    EXPECT_THAT(tile.head, testing::HasSubstr("Content-Type: application/vnd.quantized-mesh\r\n"));
    EXPECT_THAT(tile.head, testing::HasSubstr("Content-Encoding: gzip\r\n"));
    EXPECT_GT(Gunzip(tile.body).size(), tile.body.size());
  }
}

TEST_F(ServiceE2e, ServesPartsAndKnowsWhatTheClientHas) {
  StartStandIn();
  const std::string job = Submit("good.asc");
  ASSERT_EQ(WaitForEnd(job), "successful");
  const std::string report = job + "/results/report.json";
  const RawAnswer whole = Ask(port_, "GET", report);
  EXPECT_EQ(whole.body, R"({"descriptors": -1, "environment": "closed"})");
  EXPECT_NE(whole.head.find("X-Content-Type-Options: nosniff"), std::string::npos);
  EXPECT_NE(whole.head.find("Content-Disposition: attachment"), std::string::npos);
  const std::size_t at = whole.head.find("ETag: ") + 6;
  const std::string tag = whole.head.substr(at, whole.head.find("\r\n", at) - at);
  EXPECT_EQ(Ask(port_, "GET", report, "If-None-Match: " + tag + "\r\n").status, 304);
  const RawAnswer part = Ask(port_, "GET", report, "Range: bytes=1-13\r\n");
  EXPECT_EQ(part.status, 206);
  EXPECT_EQ(part.body, "\"descriptors\"");
  EXPECT_EQ(Ask(port_, "GET", report, "Range: bytes=1000-\r\n").status, 416);
  const RawAnswer head = Ask(port_, "HEAD", report);
  EXPECT_EQ(head.status, 200);
  EXPECT_TRUE(head.body.empty());
  EXPECT_NE(head.head.find("Content-Length: 44"), std::string::npos);
  EXPECT_EQ(Ask(port_, "GET", job + "/results/other").status, 404);
}

TEST_F(ServiceE2e, AWorkerEndsItsOwnJobAlone) {
  StartStandIn({"FARHORIZON_WORKER_WALL_SECONDS=8", "FARHORIZON_WORKER_CPU_SECONDS=1",
                "FARHORIZON_WORKER_FILE_BYTES=4194304", "FARHORIZON_WORKERS=3"});
  const std::vector<std::pair<std::string, std::string>> fates = {
      {"segv", "worker-crashed"},    {"exit3", "worker-crashed"}, {"nonsense", "worker-crashed"},
      {"endless", "worker-crashed"}, {"flood", "worker-crashed"}, {"liar", "worker-crashed"},
      {"hang", "timeout"},           {"spin", "timeout"},         {"large", "file-limit"},
      {"refused", "no-crs"}};
  std::vector<std::string> jobs;
  for (const auto& [name, code] : fates) jobs.push_back(Submit(name + ".asc"));
  const std::string good = Submit("good.asc");
  EXPECT_EQ(WaitForEnd(good), "successful");
  for (std::size_t i = 0; i < fates.size(); ++i) {
    EXPECT_EQ(WaitForEnd(jobs[i]), "failed") << fates[i].first;
    EXPECT_EQ(FailureOf(jobs[i]), fates[i].second) << fates[i].first;
  }
  EXPECT_EQ(StatusOf(jobs[0])["attempt"], 2);      // a crash is forgiven once
  EXPECT_EQ(StatusOf(jobs.back())["attempt"], 1);  // a refusal is final
  const std::string named = "no reference system; give crs=EPSG:4326";
  EXPECT_EQ(StatusOf(jobs.back())["message"], named);
  EXPECT_EQ(StatusOf(jobs.back())["exception"]["detail"], named);
  EXPECT_EQ(json::parse(Ask(port_, "GET", jobs.back() + "/results").body)["detail"], named);
  EXPECT_EQ(Ask(port_, "GET", "/readyz").status, 200);
  EXPECT_EQ(LeftOver("work"), 0U);
}

TEST_F(ServiceE2e, AProbeRefusesOrLeavesItToTheJob) {
  StartStandIn();
  const RawAnswer large = Ask(port_, "POST", "/jobs?filename=unreadable.asc",
                              "Content-Type: application/octet-stream\r\n", SmallGrid());
  EXPECT_EQ(large.status, 413);
  EXPECT_EQ(json::parse(large.body)["code"], "raster-too-large");
  EXPECT_EQ(WaitForEnd(Submit("probe-segv.asc")), "failed");
  EXPECT_EQ(WaitForEnd(Submit("probe-memory.asc")), "successful") << "a job may have more of it";
}

TEST_F(ServiceE2e, AStatusSaysWhatWasAssumed) {
  StartStandIn();
  const json expected = {
      {{"code", "height-unit"}, {"text", "taken for feet; state it with heightUnit=m"}},
      {{"code", "void"}, {"text", "-32768 is no data; state it with nodata"}}};
  const RawAnswer accepted =
      Ask(port_, "POST", "/jobs?filename=assumes.asc", "Content-Type: text/plain\r\n", SmallGrid());
  ASSERT_EQ(accepted.status, 201) << accepted.body;
  EXPECT_EQ(json::parse(accepted.body)["assumptions"], expected) << "known before the job runs";
  const std::string job = "/jobs/" + json::parse(accepted.body).value("jobID", "");
  EXPECT_EQ(WaitForEnd(job), "successful");
  EXPECT_EQ(StatusOf(job)["assumptions"], expected);
  const std::string crashed = Submit("assumes-segv.asc");
  EXPECT_EQ(WaitForEnd(crashed), "failed");
  EXPECT_EQ(StatusOf(crashed)["attempt"], 2);
  EXPECT_EQ(StatusOf(crashed)["assumptions"], expected) << "not doubled by the second run";
  SpillFile(folder_ / "assumes.asc", SmallGrid());
  ASSERT_EQ(Run({"submit", (folder_ / "assumes.asc").string(), "--url",
                 "http://127.0.0.1:" + std::to_string(port_), "-o", (folder_ / "sent").string()}),
            0);
  EXPECT_EQ(SlurpFile(folder_ / "stderr"),
            "farhorizon: assumed: taken for feet; state it with heightUnit=m\n"
            "farhorizon: assumed: -32768 is no data; state it with nodata\n");
}

TEST_F(ServiceE2e, WhatNoJobCouldBuildIsRefusedAtOnce) {
  Start();
  struct Case {
    const char* query;
    int status;
    const char* code;
  };
  for (const Case& one :
       std::initializer_list<Case>{{"crs=EPSG:999999", 422, "unknown-crs"},
                                   {"crs=EPSG:4326%20nothing", 422, "unknown-crs"},
                                   {"crs=EPSG:4326&maxError=1e-9", 400, "max-error-too-small"},
                                   {"crs=EPSG:4326&nodata=-inf&nodata=x", 400, "invalid-parameter"},
                                   {"crs=EPSG:4326&heightUnit=yd", 400, "invalid-parameter"}}) {
    const RawAnswer answer = Ask(port_, "POST", std::string("/jobs?filename=a.asc&") + one.query,
                                 "Content-Type: text/plain\r\n", SmallGrid());
    EXPECT_EQ(answer.status, one.status) << one.query << answer.body;
    EXPECT_EQ(json::parse(answer.body).value("code", ""), one.code) << one.query;
    EXPECT_EQ(answer.body.find("--"), std::string::npos) << answer.body;
  }
  std::string empty = "ncols 3\nnrows 2\nxllcorner 7\nyllcorner 46\ncellsize 1\nNODATA_value 0\n";
  for (const char* values : {"1 0 0\n0 0 2\n", "0 0 0\n0 0 0\n"}) {
    const RawAnswer answer = Ask(port_, "POST", "/jobs?filename=a.asc&crs=EPSG:4326",
                                 "Content-Type: text/plain\r\n", empty + values);
    EXPECT_EQ(answer.status, 422) << answer.body;
  }
  EXPECT_TRUE(json::parse(Ask(port_, "GET", "/jobs").body)["jobs"].empty());
}

TEST_F(ServiceE2e, ARemedyIsAParameterThatHelps) {
  Start();
  std::string grid = SmallGrid();
  grid.replace(grid.find("600 "), 4, "25000 ");  // no ground on Earth
  const auto post = [&](const std::string& query) {
    return Ask(port_, "POST", "/jobs?filename=a.asc" + query, "Content-Type: text/plain\r\n", grid);
  };
  std::string query;
  for (const auto& [code, remedy] : std::vector<std::pair<std::string, std::string>>{
           {"no-crs", "crs"}, {"height-out-of-range", "nodata=25000"}}) {
    const RawAnswer refused = post(query);
    EXPECT_EQ(refused.status, 422) << refused.body;
    const json problem = json::parse(refused.body);
    EXPECT_EQ(problem.value("code", ""), code);
    EXPECT_THAT(problem.value("detail", ""), testing::HasSubstr("with " + remedy));
    query += "&" + (remedy == "crs" ? "crs=EPSG:4326" : remedy);
  }
  EXPECT_EQ(post(query).status, 201);
}

TEST_F(ServiceE2e, APlusInAQueryIsWhatWasMeant) {
  Start();
  for (const char* crs :
       {"EPSG:4326+5773", "EPSG:4326%2B5773", "EPSG%3A4326%2B5773", "EPSG:4326%205773"}) {
    const RawAnswer answer = Ask(port_, "POST", std::string("/jobs?filename=a.asc&crs=") + crs,
                                 "Content-Type: text/plain\r\n", SmallGrid());
    const std::string code = json::parse(answer.body).value("code", "");
    EXPECT_TRUE(answer.status == 201 || code == "no-geoid-grid") << crs << answer.body;
  }
}

TEST_F(ServiceE2e, KillLosesNothingThatWasAcknowledged) {
  StartStandIn({"FARHORIZON_WORKERS=1"});
  std::vector<std::string> jobs;
  for (const char* name : {"slow-1.asc", "good-2.asc", "good-3.asc"}) jobs.push_back(Submit(name));
  ASSERT_EQ(WaitFor(jobs[0], {"running"}), "running");
  service_->Signal(SIGKILL);
  ASSERT_EQ(service_->Wait(), 128 + SIGKILL);
  StartStandIn({"FARHORIZON_WORKERS=1"});
  for (const std::string& job : jobs) {
    EXPECT_EQ(WaitForEnd(job), "successful") << job;
    EXPECT_EQ(Ask(port_, "GET", job + "/results/report.json").status, 200);
  }
  EXPECT_EQ(StatusOf(jobs[0])["attempt"], 2);
  EXPECT_EQ(LeftOver("spool") + LeftOver("work"), 0U);
}

TEST_F(ServiceE2e, TermLetsShortJobsEndAndGivesLongOnesBack) {
  StartStandIn({"FARHORIZON_JOBS_DRAIN_SECONDS=1", "FARHORIZON_WORKERS=1"});
  const std::string job = Submit("slow.asc");
  ASSERT_EQ(WaitFor(job, {"running"}), "running");
  service_->Signal(SIGTERM);
  int ready = 200;
  for (int tries = 0; tries < 100 && ready == 200; ++tries)
    ready = Ask(port_, "GET", "/readyz").status;
  EXPECT_EQ(ready, 503);
  EXPECT_EQ(service_->Wait(std::chrono::seconds(15)), 0);
  StartStandIn();
  EXPECT_EQ(WaitForEnd(job), "successful");
}

TEST_F(ServiceE2e, DismissalStopsTheWorker) {
  StartStandIn({"FARHORIZON_WORKERS=1"});
  const std::string job = Submit("hang.asc");
  ASSERT_EQ(WaitFor(job, {"running"}), "running");
  EXPECT_EQ(json::parse(Ask(port_, "DELETE", job).body)["status"], "dismissed");
  EXPECT_EQ(WaitForEnd(Submit("good.asc")), "successful");  // the only slot is free again
  EXPECT_EQ(StatusOf(job)["status"], "dismissed");
  EXPECT_EQ(Ask(port_, "GET", job + "/results").status, 404);
}

TEST_F(ServiceE2e, OneKeyMakesOneJob) {
  StartStandIn();
  const std::string first = Submit("good.asc", "Idempotency-Key: \"k\"\r\n");
  EXPECT_EQ(Submit("good.asc", "Idempotency-Key: \"k\"\r\n"), first);
  EXPECT_EQ(json::parse(Ask(port_, "GET", "/jobs").body)["jobs"].size(), 1U);
}

TEST_F(ServiceE2e, HostileRequestsAreRefusedAndTheServiceLives) {
  StartStandIn({"FARHORIZON_HTTP_MAX_BODY_BYTES=1000", "FARHORIZON_HTTP_HEAD_SECONDS=1",
                "FARHORIZON_HTTP_BODY_GRACE_SECONDS=1", "FARHORIZON_HTTP_MAX_HEAD_BYTES=4096"});
  const auto status = [&](const std::string& bytes) { return Exchange(port_, bytes).status; };
  const std::string post = "POST /jobs HTTP/1.1\r\nHost: a\r\nContent-Type: image/tiff\r\n";
  EXPECT_EQ(status("GET / HTTP/1.1\r\n\r\n"), 400);
  EXPECT_EQ(status(post + "Content-Length: 3\r\nTransfer-Encoding: chunked\r\n\r\n"), 400);
  EXPECT_EQ(status(post + "Transfer-Encoding: chunked, identity\r\n\r\n"), 501);
  EXPECT_EQ(status(post + "Transfer-Encoding: chunked\r\n\r\nzz\r\n"), 400);
  EXPECT_EQ(status(post + "Content-Length: 1001\r\n\r\n"), 413);
  EXPECT_EQ(status(post + "Transfer-Encoding: chunked\r\n\r\n7d0\r\n" + std::string(2000, 'I') +
                   "\r\n0\r\n\r\n"),
            413);
  EXPECT_EQ(status("GET / HTTP/1.1\r\nX: " + std::string(5000, 'a')), 431);
  EXPECT_EQ(status("GET / HT"), 408);                               // never goes on
  EXPECT_EQ(status(post + "Content-Length: 100\r\n\r\nII*"), 408);  // nor this
  EXPECT_EQ(status(post + "Content-Length: 1001\r\nExpect: 100-continue\r\n\r\n"), 413);
  EXPECT_EQ(status("GET /healthz HTTP/1.1\r\nHost: a\r\nConnection: close\r\n\r\n"), 200);
  EXPECT_EQ(LeftOver("spool"), 0U);
}

TEST_F(ServiceE2e, AsksForABodyOnlyWhenItWillTakeIt) {
  StartStandIn();
  const std::string grid = SmallGrid();
  const std::string head =
      "POST /jobs?crs=EPSG:4326&filename=good.asc HTTP/1.1\r\nHost: a\r\n"
      "Connection: close\r\nContent-Type: application/octet-stream\r\n"
      "Expect: 100-continue\r\nContent-Length: " +
      std::to_string(grid.size()) + "\r\n\r\n";
  const RawAnswer answer = Exchange(port_, head + grid);
  EXPECT_EQ(answer.status, 100);
  EXPECT_NE(answer.body.find("HTTP/1.1 201 Created"), std::string::npos);
}

TEST_F(ServiceE2e, AnswersRequestAfterRequestOnOneConnection) {
  StartStandIn();
  const std::string get = "GET /healthz HTTP/1.1\r\nHost: a\r\n";
  const RawAnswer answer =
      Exchange(port_, get + "\r\n" + get + "\r\n" + get + "Connection: close\r\n\r\n");
  std::size_t count = 0;
  const std::string all = answer.head + answer.body;
  for (std::size_t at = 0; (at = all.find("HTTP/1.1 200 OK", at)) != std::string::npos; ++at)
    ++count;
  EXPECT_EQ(count, 3U);
}

TEST_F(ServiceE2e, ABodyEndsWhereItsHeadSays) {
  StartStandIn();
  const std::string inside = "GET /inside HTTP/1.1\r\nHost: a\r\n\r\n";
  const std::string post = "POST /jobs HTTP/1.1\r\nHost: a\r\nContent-Type: image/tiff\r\n";
  const std::string last = "GET /healthz HTTP/1.1\r\nHost: a\r\nConnection: close\r\n\r\n";
  ASSERT_EQ(inside.size(), 33U);
  for (const std::string& framed :
       {"Content-Length: 33\r\n\r\n" + inside,
        "Transfer-Encoding: Chunked\r\n\r\n21;x=y\r\n" + inside + "\r\n0\r\nTrailer: a\r\n\r\n",
        "Connection: upgrade\r\nUpgrade: x\r\nContent-Length: 0033\r\n\r\n" + inside}) {
    const RawAnswer answer = Exchange(port_, post + framed + last);
    EXPECT_EQ(answer.status, 415) << answer.head;
    const std::size_t second = answer.body.find("HTTP/1.1 ");
    ASSERT_NE(second, std::string::npos) << framed;
    EXPECT_EQ(answer.body.substr(second, 15), "HTTP/1.1 200 OK");
    EXPECT_EQ(answer.body.find("HTTP/1.1 ", second + 1), std::string::npos);
  }
}

TEST_F(ServiceE2e, BoundsConnections) {
  StartStandIn({"FARHORIZON_HTTP_MAX_CONNECTIONS=4"});
  std::vector<int> idle;
  for (int i = 0; i < 4; ++i) idle.push_back(Connect(port_));
  EXPECT_EQ(Ask(port_, "GET", "/jobs").status, 503);
  EXPECT_EQ(Ask(port_, "GET", "/healthz").status, 200);  // operators still get an answer
  for (const int fd : idle) ::close(fd);
  int status = 503;
  for (int tries = 0; tries < 200 && status != 200; ++tries) {
    status = Ask(port_, "GET", "/jobs").status;
  }
  EXPECT_EQ(status, 200);
}

TEST_F(ServiceE2e, RefusesToStartWhereItCannotWork) {
  StartStandIn();
  const auto serve = [&](const std::string& data, const std::string& listen) {
    return Run({"serve", "--listen", listen, "--data", data});
  };
  EXPECT_EQ(serve((folder_ / "data").string(), "127.0.0.1:0"), 1);
  EXPECT_NE(SlurpFile(folder_ / "stderr").find("in use by another farhorizon"), std::string::npos);
  EXPECT_EQ(serve((folder_ / "d2").string(), "127.0.0.1:" + std::to_string(port_)), 1);
  EXPECT_EQ(serve((folder_ / "d2").string(), "nowhere"), 2);
  EXPECT_EQ(serve("/proc/farhorizon", "127.0.0.1:0"), 1);
}

TEST_F(ServiceE2e, ExitStatusTellsWhoseFaultItIs) {
  EXPECT_EQ(Run({"build"}), 2);
  EXPECT_EQ(Run({"build", "x", "-o", "y", "--levels", "99"}), 2);
  EXPECT_EQ(Run({"nothing"}), 2);
  EXPECT_EQ(Run({"build", (folder_ / "none.tif").string(), "-o", (folder_ / "o").string()}), 1);
  EXPECT_EQ(Run({"submit", __FILE__, "--url", "ftp://x", "-o", (folder_ / "o").string()}), 2);
  EXPECT_EQ(Run({"healthcheck", "--url", "http://127.0.0.1:1"}), 1);
  StartStandIn();
  EXPECT_EQ(Run({"healthcheck", "--url", "http://127.0.0.1:" + std::to_string(port_)}), 0);
}

}  // namespace
}  // namespace farhorizon
