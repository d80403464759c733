// The program as a client of the service: status, wait, fetch, cancel, and many DEMs at once.
#include <chrono>
#include <fstream>
#include <limits>
#include <signal.h>
#include <string>
#include <sys/socket.h>
#include <thread>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "core/io/sha256.h"
#include "tests/support/cutting_proxy.h"
#include "tests/support/loopback_server.h"
#include "tests/support/service_fixture.h"

namespace farhorizon {
namespace {

using nlohmann::json;
using testing::HasSubstr;

class ClientE2e : public ServiceE2e {
 protected:
  // Runs `farhorizon WORDS --url …`; what it prints is in out_.
  int Client(const std::string& words, const std::string& url = "") {
    const std::filesystem::path out = folder_ / "out.txt";
    const std::string command = std::string("exec '") + FARHORIZON_PROGRAM + "' " + words +
                                " --url " +
                                (url.empty() ? "http://127.0.0.1:" + std::to_string(port_) : url) +
                                " > '" + out.string() + "'";
    std::filesystem::remove(folder_ / "stderr");
    const int status =
        Process({"/bin/sh", "-c", command}, {}, folder_ / "stderr").Wait(std::chrono::seconds(200));
    out_ = SlurpFile(out);
    return status;
  }
  std::string Said() { return SlurpFile(folder_ / "stderr"); }
  static std::string IdOf(const std::string& path) { return path.substr(6); }
  std::size_t CountJobs() {
    return json::parse(Ask(port_, "GET", "/jobs?limit=1000").body)["jobs"].size();
  }

  std::string out_;
};

TEST_F(ClientE2e, AsksWaitsFetchesAndCancels) {
  StartStandIn({"FARHORIZON_WORKERS=2"});
  const std::string slow = Submit("slow.asc");
  ASSERT_EQ(Client("status " + IdOf(slow)), 0) << Said();
  EXPECT_EQ("/jobs/" + json::parse(out_).value("jobID", ""), slow);
  const std::string out = (folder_ / "fetched").string();
  ASSERT_EQ(Client("wait http://127.0.0.1:" + std::to_string(port_) + slow), 0) << Said();
  EXPECT_EQ(json::parse(out_)["status"], "successful");
  ASSERT_EQ(Client("fetch " + IdOf(slow) + " -o " + out), 0) << Said();
  EXPECT_EQ(SlurpFile(out + "/report.json"), Ask(port_, "GET", slow + "/results/report.json").body);
  EXPECT_TRUE(std::filesystem::exists(out + "/manifest.json"));
  EXPECT_FALSE(std::filesystem::exists(out + "/report.json.part"));

  const std::string hang = Submit("hang.asc");
  EXPECT_EQ(Client("wait " + IdOf(hang) + " --timeout 1"), 75) << Said();
  EXPECT_EQ(Client("fetch " + IdOf(hang) + " -o " + out + "-none"), 1);
  EXPECT_THAT(Said(), HasSubstr("result-not-ready"));
  ASSERT_EQ(Client("cancel " + IdOf(hang)), 0) << Said();
  EXPECT_EQ(json::parse(out_)["status"], "dismissed");
  EXPECT_EQ(Client("wait " + IdOf(hang)), 1);
  const std::string failed = Submit("refused.asc");
  EXPECT_EQ(Client("wait " + IdOf(failed)), 1);
  EXPECT_THAT(Said(), HasSubstr("no-crs"));
  EXPECT_EQ(json::parse(out_)["status"], "failed");

  EXPECT_EQ(Client("status 0190f1e2-0000-7000-8000-000000000000"), 1);
  EXPECT_EQ(Client("status x"), 2);
  EXPECT_EQ(Client("status " + IdOf(slow) + " --patience 0", "http://127.0.0.1:1"), 75);
}

TEST_F(ClientE2e, GoesOnWithADownloadThatIsCutOff) {
  Start();
  const std::string job = Submit("a.asc&levels=2");
  ASSERT_EQ(WaitForEnd(job), "successful");
  const std::string out = (folder_ / "fetched").string();
  // What lies there already: a beginning that is right, one that is not, and one that is too long.
  std::filesystem::create_directories(out);
  const std::string report = Ask(port_, "GET", job + "/results/report.json").body;
  SpillFile(out + "/report.json.part", report.substr(0, 100));
  SpillFile(out + "/tileset.json.part", "nonsense");
  SpillFile(out + "/lod0.drc.part", std::string(1'000'000, 'x'));
  const CuttingProxy proxy(port_, [](int connection) {
    return connection % 2 == 1 ? std::size_t{3000} : std::numeric_limits<std::size_t>::max();
  });
  ASSERT_EQ(Client("fetch " + IdOf(job) + " -o " + out,
                   "http://127.0.0.1:" + std::to_string(proxy.port())),
            0)
      << Said();
  const json manifest = json::parse(SlurpFile(out + "/manifest.json"));
  std::size_t files = 1;
  std::size_t large = 0;
  for (const json& entry : manifest["artifacts"]) {
    const std::string name = entry["name"];
    EXPECT_EQ(Sha256Hex(SlurpFile(out + "/" + name)), entry["sha256"]) << name;
    ++files;
    large += entry["bytes"] > 3000 ? 1 : 0;
  }
  EXPECT_GE(large, 2U) << "nothing was cut off";
  EXPECT_EQ(std::distance(std::filesystem::directory_iterator(out), {}),
            static_cast<std::ptrdiff_t>(files));
  EXPECT_THAT(SlurpFile(folder_ / "log"), HasSubstr("\"status\":206"));
  // All is there: only the manifest is asked for.
  const int before = proxy.connections();
  ASSERT_EQ(Client("fetch " + IdOf(job) + " -o " + out,
                   "http://127.0.0.1:" + std::to_string(proxy.port())),
            0);
  EXPECT_LE(proxy.connections() - before, 2);
}

// A service that answers whatever a test wants it to.
class HostileE2e : public ClientE2e {
 protected:
  // manifest: of its results. artifact: the whole answer to a request for anything else.
  int FetchFrom(const json& manifest, const std::string& artifact) {
    const auto with_length = [](const std::string& body) {
      return "HTTP/1.1 200 OK\r\nContent-Length: " + std::to_string(body.size()) + "\r\n\r\n" +
             body;
    };
    const std::string listed = with_length(manifest.dump());
    LoopbackServer server;
    server.Start([=](int client) {
      std::string request(4096, '\0');
      if (::recv(client, request.data(), request.size(), 0) <= 0) return;
      const bool asks_list = request.find("/manifest.json ") != std::string::npos;
      const std::string& answer = asks_list ? listed : artifact;
      for (std::size_t sent = 0; sent < answer.size();) {
        const ssize_t size =
            ::send(client, answer.data() + sent, answer.size() - sent, MSG_NOSIGNAL);
        if (size <= 0) return;
        sent += static_cast<std::size_t>(size);
      }
    });
    return Client("fetch 0190f1e2-0000-7000-8000-000000000000 --patience 0 -o " + out_folder_,
                  "http://127.0.0.1:" + std::to_string(server.port()));
  }
  static json Entry(const std::string& name, std::size_t bytes = 12) {
    return {{"name", name},
            {"media_type", "text/plain"},
            {"bytes", bytes},
            {"sha256", Sha256Hex("twelve bytes")}};
  }
  static json Manifest(const std::vector<json>& entries) { return {{"artifacts", entries}}; }
  std::size_t FilesFetched() {
    if (!std::filesystem::exists(out_folder_)) return 0;
    return static_cast<std::size_t>(
        std::distance(std::filesystem::directory_iterator(out_folder_), {}));
  }

  const std::string out_folder_ = (folder_ / "fetched").string();
};

TEST_F(HostileE2e, AnArtifactIsReadNoFurtherThanItsEnd) {
  // Sixteen mebibytes, and no word of how many there are.
  const std::string endless = "HTTP/1.1 200 OK\r\n\r\n" + std::string(std::size_t{1} << 24U, 'x');
  EXPECT_EQ(FetchFrom(Manifest({Entry("a")}), endless), 1);
  EXPECT_THAT(Said(), HasSubstr("a: the service sends more than it says there is"));
  EXPECT_EQ(FilesFetched(), 0U);
}

TEST_F(HostileE2e, AManifestOfWhatCannotBeIsRefused) {
  const std::string whole = "HTTP/1.1 200 OK\r\nContent-Length: 12\r\n\r\ntwelve bytes";
  const std::vector<std::pair<std::vector<json>, std::string>> cases = {
      {{Entry("a.part"), Entry("a")}, "names a.part, as a file is called"},
      {{Entry("a"), Entry("a")}, "names a twice"},
      {{Entry("manifest.json")}, "names manifest.json twice"},
      {{Entry("../a")}, "names an artifact that cannot be a file"},
      {std::vector<json>(4001, Entry("a")), "names more than 4000 files"}};
  for (const auto& [entries, why] : cases) {
    EXPECT_EQ(FetchFrom(Manifest(entries), whole), 1) << why;
    EXPECT_THAT(Said(), HasSubstr(why));
    EXPECT_EQ(FilesFetched(), 0U) << why;
  }
  EXPECT_EQ(FetchFrom("no manifest", whole), 1);
  EXPECT_THAT(Said(), HasSubstr("cannot be read; is it a farhorizon?"));
  EXPECT_EQ(FetchFrom(Manifest({Entry("a"), Entry("b")}), whole), 0) << Said();
  EXPECT_EQ(FilesFetched(), 3U);
}

TEST_F(HostileE2e, ATerminalObeysNoneOfItsWords) {
  const std::string problem = R"({"code": "\u001b[31mred", "detail": "one\nfarhorizon: two"})";
  const std::string answer =
      "HTTP/1.1 500 No\r\nContent-Length: " + std::to_string(problem.size()) + "\r\n\r\n" + problem;
  EXPECT_EQ(FetchFrom(Manifest({Entry("a")}), answer), 1);
  EXPECT_EQ(Said(), "farhorizon: a: the service answered 500  [31mred: one farhorizon: two\n");
}

TEST_F(ClientE2e, SendsAFolderAndGoesOnWhereItWasCutOff) {
  StartStandIn({"FARHORIZON_WORKERS=1"});
  const std::string tiles = (folder_ / "tiles").string();
  std::filesystem::create_directories(tiles);
  for (const char* name : {"slow1.asc", "slow2.asc", "plain.asc"}) {
    SpillFile(tiles + "/" + name, SmallGrid() + "\n" + name);
  }
  const std::string table = (folder_ / "out" / "jobs.tsv").string();
  const std::string words = "submit " + tiles + " -o " + (folder_ / "out").string() +
                            " --crs EPSG:4326 --at-once 3 --progress none";
  {
    const std::string url = " --url http://127.0.0.1:" + std::to_string(port_);
    const Process cut(
        {"/bin/sh", "-c", std::string("exec '") + FARHORIZON_PROGRAM + "' " + words + url}, {},
        folder_ / "stderr");
    while (CountJobs() < 2) std::this_thread::sleep_for(std::chrono::milliseconds(10));
    cut.Signal(SIGKILL);
  }
  ASSERT_EQ(Client(words), 0) << Said();
  EXPECT_EQ(CountJobs(), 3U) << "a second job of the same DEM";
  for (const char* name : {"slow1.asc", "slow2.asc", "plain.asc"}) {
    EXPECT_TRUE(std::filesystem::exists(folder_ / "out" / name / "manifest.json")) << name;
    EXPECT_THAT(SlurpFile(table), HasSubstr(std::string(name) + "\t"));
  }
  EXPECT_THAT(Said(), HasSubstr("3 of 3 DEMs are done"));

  // Some that the service refuses, or whose job fails; the rest are done all the same.
  SpillFile(tiles + "/refused.asc", SmallGrid());
  SpillFile(tiles + "/nonsense.asc", "nonsense");
  EXPECT_EQ(Client(words), 1);
  EXPECT_EQ(CountJobs(), 4U);
  const std::string said = SlurpFile(table);
  EXPECT_THAT(said, testing::ContainsRegex("refused.asc\t[0-9a-f-]+\tfailed\tno-crs\t"));
  EXPECT_THAT(said, testing::ContainsRegex("nonsense.asc\t\trefused\tnot-a-raster\t"));
  // Other parameters are other jobs.
  EXPECT_EQ(Client("submit " + tiles + "/plain.asc " + tiles + "/slow1.asc -o " +
                   (folder_ / "out").string() + " --crs EPSG:4326 --levels 1"),
            0)
      << Said();
  EXPECT_EQ(CountJobs(), 6U);
  // A service that is away loses nothing.
  service_->Signal(SIGKILL);
  service_->Wait();
  std::filesystem::remove_all(folder_ / "out" / "plain.asc");
  EXPECT_EQ(Client("submit " + tiles + "/plain.asc " + tiles + "/slow1.asc -o " +
                   (folder_ / "out").string() + " --crs EPSG:4326 --levels 1 --patience 0"),
            75)
      << Said();
  EXPECT_THAT(SlurpFile(table), HasSubstr("\tunreached\tconnection\t"));
}

TEST_F(ClientE2e, AllArtifactsComeAsOneArchive) {
  Start();
  const std::string job = Submit("a.asc&levels=2");
  ASSERT_EQ(WaitForEnd(job), "successful");
  const std::string url = "http://127.0.0.1:" + std::to_string(port_);
  ASSERT_EQ(Client("fetch " + IdOf(job) + " -o " + (folder_ / "fetched").string()), 0) << Said();
  for (const std::string form : {"zip", "tar"}) {
    const RawAnswer whole = Ask(port_, "GET", job + "/results?f=" + form);
    ASSERT_EQ(whole.status, 200) << whole.body;
    EXPECT_THAT(whole.head, HasSubstr("filename=\"" + IdOf(job) + "." + form + "\""));
    EXPECT_THAT(whole.head, HasSubstr("Content-Length: " + std::to_string(whole.body.size())));
    const std::string archive = (folder_ / ("all." + form)).string();
    SpillFile(archive, whole.body);
    const std::string out = (folder_ / ("out-" + form)).string();
    std::filesystem::create_directories(out);
    const std::string command = form == "zip" ? "exec python3 -m zipfile -e " + archive + " " + out
                                              : "exec tar -xf " + archive + " -C " + out;
    ASSERT_EQ(Process({"/bin/sh", "-c", command}, {}, folder_ / "stderr").Wait(), 0) << Said();
    std::size_t files = 0;
    for (const auto& entry : std::filesystem::directory_iterator(folder_ / "fetched")) {
      const std::string name = entry.path().filename().string();
      EXPECT_EQ(SlurpFile(entry.path()), SlurpFile(out + "/" + name)) << name;
      ++files;
    }
    EXPECT_EQ(std::distance(std::filesystem::directory_iterator(out), {}),
              static_cast<std::ptrdiff_t>(files));
    const std::size_t half = whole.body.size() / 2;
    const RawAnswer rest = Ask(port_, "GET", job + "/results?f=" + form,
                               "Range: bytes=" + std::to_string(half) + "-\r\n");
    EXPECT_EQ(rest.status, 206);
    EXPECT_EQ(rest.body, whole.body.substr(half));
    const std::string head = Ask(port_, "HEAD", job + "/results?f=" + form).head;
    const std::size_t tag = head.find("ETag: ") + 6;
    EXPECT_EQ(Ask(port_, "GET", job + "/results?f=" + form,
                  "If-None-Match: " + head.substr(tag, head.find('\r', tag) - tag) + "\r\n")
                  .status,
              304);
  }
  EXPECT_EQ(Ask(port_, "GET", job + "/results?f=rar").status, 400);
  EXPECT_EQ(Ask(port_, "GET", Submit("b.asc&levels=1") + "/results?f=zip").status, 404);
}

}  // namespace
}  // namespace farhorizon
