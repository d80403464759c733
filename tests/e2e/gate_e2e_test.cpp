// What the service does with strangers: pages, flooders, readers that do not read.
#include <array>
#include <fcntl.h>
#include <fstream>
#include <signal.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <unistd.h>

#include "core/io/unique_fd.h"
#include "tests/support/service_fixture.h"

namespace farhorizon {
namespace {

using testing::HasSubstr;
using testing::Not;

class GateE2e : public ServiceE2e {};

std::string CodeOfProblem(const RawAnswer& answer) {
  return nlohmann::json::parse(answer.body).value("code", "");
}

TEST_F(GateE2e, ALogThatNobodyReadsStopsNothing) {
  const std::string pipe = (folder_ / "log").string();
  ASSERT_EQ(::mkfifo(pipe.c_str(), 0600), 0);
  const UniqueFd reader(::open(pipe.c_str(), O_RDWR | O_NONBLOCK | O_CLOEXEC));
  ASSERT_TRUE(reader);
  service_ = std::make_unique<Process>(Command(), std::vector<std::string>{}, pipe);
  std::string said;
  for (int i = 0; i < 2000 && said.find("\"port\":") == std::string::npos; ++i) {
    std::array<char, 4096> piece{};
    const ssize_t size = ::read(reader.get(), piece.data(), piece.size());
    if (size > 0) said.append(piece.data(), static_cast<std::size_t>(size));
    if (size <= 0) std::this_thread::sleep_for(std::chrono::milliseconds(10));
  }
  const std::size_t at = said.find("\"port\":");
  ASSERT_NE(at, std::string::npos);
  port_ = static_cast<std::uint16_t>(std::stoi(said.substr(at + 7)));
  // The pipe takes some 300 of these lines.
  for (int i = 0; i < 1000; ++i) ASSERT_EQ(Ask(port_, "GET", "/jobs").status, 200) << i;
  service_->Signal(SIGTERM);
  EXPECT_EQ(service_->Wait(), 0);
}

TEST_F(GateE2e, PagesOfOtherOriginsAndNamesOfOthersGetNothing) {
  Start();
  EXPECT_EQ(Exchange(port_,
                     "GET /jobs HTTP/1.1\r\nHost: evil.example\r\nConnection: "
                     "close\r\n\r\n")
                .status,
            421);
  const std::string evil = "Origin: https://evil.example\r\n";
  const std::string path = Submit("small.asc");
  for (const char* method : {"DELETE", "OPTIONS"}) {
    const RawAnswer answer = Ask(port_, method, path, evil);
    EXPECT_EQ(answer.status, 403) << method;
    EXPECT_THAT(answer.head, Not(HasSubstr("Access-Control-Allow-Origin"))) << method;
  }
  // As a form of a page sends it, which asks for no preflight.
  EXPECT_EQ(CodeOfProblem(Ask(port_, "POST", "/jobs", evil + "Content-Type: text/plain\r\n", "x")),
            "origin-not-allowed");
  EXPECT_THAT(Ask(port_, "GET", "/jobs", evil).head, Not(HasSubstr("Access-Control-Allow-Origin")));
  EXPECT_EQ(Ask(port_, "GET", path).status, 200);
}

TEST_F(GateE2e, PagesOfConfiguredOriginsMay) {
  Start({"FARHORIZON_HTTP_CORS_ORIGIN=https://globe.example"});
  const RawAnswer preflight =
      Ask(port_, "OPTIONS", "/jobs",
          "Origin: https://globe.example\r\nAccess-Control-Request-Method: POST\r\n"
          "Access-Control-Request-Headers: authorization, prefer\r\n");
  EXPECT_EQ(preflight.status, 204);
  EXPECT_THAT(preflight.head, HasSubstr("Access-Control-Allow-Origin: https://globe.example\r\n"));
  EXPECT_THAT(preflight.head, HasSubstr("POST"));
  EXPECT_THAT(preflight.head, HasSubstr("Authorization"));
  EXPECT_THAT(preflight.head, HasSubstr("Prefer"));
}

TEST_F(GateE2e, AnswersForItsHealthWhenConnectionsAreUsedUp) {
  std::string command = "ulimit -n 64; exec";
  for (const std::string& word : Command()) command += " '" + word + "'";
  service_ = std::make_unique<Process>(std::vector<std::string>{"/bin/sh", "-c", command},
                                       std::vector<std::string>{}, folder_ / "log");
  port_ = PortOf(folder_ / "log");
  ASSERT_NE(port_, 0) << SlurpFile(folder_ / "log");
  const std::string path = Submit("small.asc");
  std::vector<UniqueFd> held;
  for (int i = 0; i < 200; ++i) held.emplace_back(Connect(port_));
  for (int i = 0; i < 20; ++i) EXPECT_EQ(Ask(port_, "GET", "/healthz").status, 200) << i;
  held.clear();
  EXPECT_EQ(WaitForEnd(path), "successful");
}

TEST_F(GateE2e, BoundsChunkExtensionsAndTrailers) {
  Start();
  const std::string head =
      "POST /jobs?filename=small.asc&crs=EPSG:4326 HTTP/1.1\r\nHost: localhost\r\n"
      "Content-Type: application/octet-stream\r\nTransfer-Encoding: chunked\r\n\r\n";
  const std::string much(1 << 20, 'x');
  EXPECT_EQ(Exchange(port_, head + "1;a=" + much + "\r\nn\r\n0\r\n\r\n").status, 431);
  EXPECT_EQ(Exchange(port_, head + "1\r\nn\r\n0\r\nA: " + much + "\r\n\r\n").status, 431);
  std::string many = head;
  for (int i = 0; i < 1000; ++i) many += "1;" + std::string(100, 'x') + "\r\nn\r\n";
  EXPECT_EQ(Exchange(port_, many + "0\r\n\r\n").status, 431);
  std::string fields = head + "1\r\nn\r\n0\r\n";
  for (int i = 0; i < 10'000; ++i) fields += "A" + std::to_string(i) + ": x\r\n";
  EXPECT_EQ(Exchange(port_, fields + "\r\n").status, 431);
  for (const char* folded :
       {"A: x\r\n y\r\n", "A: x\r\n\ty\r\nB: z\r\n", "A: x\r\n 0\r\nB: z\r\n"}) {
    EXPECT_EQ(Exchange(port_, head + "1\r\nn\r\n0\r\n" + folded + "\r\n").status, 400) << folded;
  }
  // A body may have such lines, and a chunk's may be all that is taken at once.
  const std::string last = "GET /healthz HTTP/1.1\r\nHost: localhost\r\nConnection: close\r\n\r\n";
  for (const char* sound :
       {"5\r\n\r\n x\n\r\n0\r\nA: x\r\nB: 0\r\n\r\n", "3\r\n\r\n \r\n000;a=b\r\n\r\n"}) {
    EXPECT_THAT(Exchange(port_, head + sound + last).body, HasSubstr("HTTP/1.1 200 OK")) << sound;
  }
  EXPECT_EQ(Ask(port_, "GET", "/healthz").status, 200);
}

TEST_F(GateE2e, HoldsParametersAndBodiesToWhatTheySay) {
  Start();
  const std::string octets = "Content-Type: application/octet-stream\r\n";
  EXPECT_EQ(CodeOfProblem(Ask(port_, "POST", "/jobs?crs=%00", octets, "x")), "invalid-parameter");
  EXPECT_EQ(CodeOfProblem(Ask(port_, "POST", "/jobs",
                              octets + "Content-Digest: sha-256=:" + std::string(44, 'A') + ":\r\n",
                              "x")),
            "digest-mismatch");
}

TEST_F(GateE2e, SaysWhenAStatusIsTheSame) {
  Start();
  const std::string path = Submit("small.asc");
  ASSERT_EQ(WaitForEnd(path), "successful");
  const RawAnswer first = Ask(port_, "GET", path);
  const std::size_t at = first.head.find("ETag: ");
  ASSERT_NE(at, std::string::npos) << first.head;
  const std::string tag = first.head.substr(at + 6, first.head.find('\r', at) - at - 6);
  const RawAnswer again = Ask(port_, "GET", path, "If-None-Match: " + tag + "\r\n");
  EXPECT_EQ(again.status, 304);
  EXPECT_EQ(again.body, "");
  EXPECT_EQ(Ask(port_, "GET", path, "If-None-Match: \"other\"\r\n").status, 200);
}

TEST_F(GateE2e, TheLogTellsRequestsTracesJobsAndCodes) {
  Start();
  const std::string trace = "4bf92f3577b34da6a3ce929d0e0e4736";
  const std::string path = Submit(
      "small.asc", "X-Request-Id: mine\r\ntraceparent: 00-" + trace + "-00f067aa0ba902b7-01\r\n");
  Ask(port_, "GET", "/jobs/none");
  service_->Signal(SIGTERM);
  EXPECT_EQ(service_->Wait(), 0);
  const std::string log = SlurpFile(folder_ / "log");
  const std::string id = path.substr(path.rfind('/') + 1);
  EXPECT_THAT(log, HasSubstr("\"request_id\":\"mine\",\"trace_id\":\"" + trace +
                             "\",\"job_id\":\"" + id + "\""));
  EXPECT_THAT(log, HasSubstr("\"code\":\"no-such-job\""));
  EXPECT_THAT(log, HasSubstr("\"max_waiting\":"));
}

TEST_F(GateE2e, SignalsReloadOrDoNothing) {
  const auto configure = [&](const std::string& text) {
    std::ofstream(folder_ / "config.json") << text;
  };
  configure(R"({"http": {"corsOrigin": ""}})");
  std::vector<std::string> command = Command();
  command.insert(command.end(), {"--config", (folder_ / "config.json").string()});
  service_ = std::make_unique<Process>(command, std::vector<std::string>{}, folder_ / "log");
  port_ = PortOf(folder_ / "log");
  ASSERT_NE(port_, 0) << SlurpFile(folder_ / "log");
  const auto allowed = [&] {
    return Ask(port_, "GET", "/jobs", "Origin: https://a.example\r\n")
               .head.find("Access-Control-Allow-Origin") != std::string::npos;
  };
  EXPECT_FALSE(allowed());
  configure(R"({"http": {"corsOrigin": "https://a.example"}, "workers": 5})");
  service_->Signal(SIGHUP);
  bool now = false;
  for (int i = 0; i < 500 && !now; ++i) {
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
    now = allowed();
  }
  EXPECT_TRUE(now);
  configure("{");  // stays as it is
  for (const int signal : {SIGHUP, SIGUSR1, SIGUSR2}) service_->Signal(signal);
  std::this_thread::sleep_for(std::chrono::milliseconds(100));
  EXPECT_TRUE(allowed());
  service_->Signal(SIGTERM);
  EXPECT_EQ(service_->Wait(), 0);
  EXPECT_THAT(SlurpFile(folder_ / "log"), HasSubstr("\"key\":\"workers\""));
}

TEST_F(GateE2e, ChecksAConfiguration) {
  std::ofstream(folder_ / "good.json") << R"({"workers": 2})";
  std::ofstream(folder_ / "bad.json") << R"({"workers": 2, "workers": 3})";
  EXPECT_EQ(Run({"serve", "--check-config", "--config", (folder_ / "good.json").string()}), 0);
  EXPECT_THAT(SlurpFile(folder_ / "stderr"), HasSubstr("workers: from "));
  EXPECT_EQ(Run({"serve", "--check-config", "--config", (folder_ / "bad.json").string()}), 2);
}

}  // namespace
}  // namespace farhorizon
