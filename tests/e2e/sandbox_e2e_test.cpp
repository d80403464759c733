// What a worker that was taken over by a file can still do: nothing but its job.
#include <algorithm>
#include <filesystem>
#include <fstream>
#include <memory>
#include <set>
#include <signal.h>
#include <string>
#include <sys/resource.h>
#include <sys/stat.h>
#include <thread>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "tests/support/hilly_grid.h"
#include "tests/support/service_process.h"
#include "tests/support/temp_dir.h"

namespace farhorizon {
namespace {

using nlohmann::json;
using testing::HasSubstr;

class SandboxE2e : public testing::Test {
 protected:
  std::vector<std::string> Words() const {
    return {FARHORIZON_PROGRAM, "serve",  "--listen",
            "127.0.0.1:0",      "--data", (folder_ / "data").string()};
  }
  void Start(const std::vector<std::string>& settings) {
    service_ = std::make_unique<Process>(Words(), settings, folder_ / "log");
    port_ = PortOf(folder_ / "log");
    ASSERT_NE(port_, 0) << SlurpFile(folder_ / "log");
  }
  void StartStandIn() { Start({std::string("FARHORIZON_WORKER_PROGRAM=") + STAND_IN_WORKER}); }
  /// The exit status of a service that must not start.
  int Refused(const std::vector<std::string>& settings) {
    return Process(Words(), settings, folder_ / "log").Wait();
  }
  bool HasLayer(const std::string& name) const {
    return SlurpFile(folder_ / "log").find(name) != std::string::npos;
  }
  /// The processes that the service has started, and that run.
  std::set<int> Spawners() const {
    std::set<int> found;
    for (const auto& task : std::filesystem::directory_iterator(
             "/proc/" + std::to_string(service_->pid()) + "/task")) {
      std::ifstream list(task.path() / "children");
      for (int pid = 0; list >> pid;) found.insert(pid);
    }
    return found;
  }
  /// The stand-ins that run. A process knows its program by its link.
  static std::set<int> StandIns() {
    std::set<int> found;
    for (const auto& entry : std::filesystem::directory_iterator("/proc")) {
      std::error_code failure;
      const auto program = std::filesystem::read_symlink(entry.path() / "exe", failure);
      if (!failure && program == STAND_IN_WORKER) found.insert(std::stoi(entry.path().filename()));
    }
    return found;
  }
  json Run(const std::string& name, const std::string& query = "crs=EPSG:4326") {
    const RawAnswer answer = Ask(port_, "POST", "/jobs?" + query + "&levels=1&filename=" + name,
                                 "Content-Type: application/octet-stream\r\n", HillyGrid(12, 10));
    EXPECT_EQ(answer.status, 201) << answer.body;
    job_ = "/jobs/" + json::parse(answer.body).value("jobID", "");
    json info;
    for (int tries = 0; tries < 3000; ++tries) {
      info = json::parse(Ask(port_, "GET", job_).body);
      const std::string status = info.value("status", "");
      if (status == "successful" || status == "failed") break;
      std::this_thread::sleep_for(std::chrono::milliseconds(20));
    }
    return info;
  }

  TempDir folder_;
  std::unique_ptr<Process> service_;
  std::uint16_t port_ = 0;
  std::string job_;
};

TEST_F(SandboxE2e, AWorkerReachesNothingButItsJob) {
  StartStandIn();
  if (!HasLayer("landlock") || !HasLayer("seccomp")) {
    GTEST_SKIP() << "this kernel or container has not all layers";
  }
  ASSERT_EQ(Run("escape.asc")["status"], "successful");
#if defined(__SANITIZE_ADDRESS__)
  const std::string done = "done:\nmore memory\n";  // the sanitizer reserves terabytes
#else
  const std::string done = "done:\n";
#endif
  EXPECT_EQ(Ask(port_, "GET", job_ + "/results/report.json").body, done);
}

TEST_F(SandboxE2e, NoProcessOfAWorkerOutlivesIt) {
  StartStandIn();
  EXPECT_EQ(Run("children.asc")["exception"]["code"], "worker-crashed");
  for (int tries = 0; tries < 200 && !StandIns().empty(); ++tries) {
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
  }
  EXPECT_THAT(StandIns(), testing::IsEmpty());
}

TEST_F(SandboxE2e, AJobStandsBackBehindWhatClientsWaitFor) {
  StartStandIn();
  const int wanted = std::min(19, ::getpriority(PRIO_PROCESS, 0) + 10);
  std::set<int> niceness;
  std::thread look([&niceness, wanted] {
    for (int tries = 0; tries < 200 && !niceness.contains(wanted); ++tries) {
      for (const int pid : StandIns()) niceness.insert(::getpriority(PRIO_PROCESS, id_t(pid)));
      std::this_thread::sleep_for(std::chrono::milliseconds(20));
    }
  });
  EXPECT_EQ(Run("slow.asc")["status"], "successful");
  look.join();
  EXPECT_THAT(niceness, testing::Contains(wanted));
}

TEST_F(SandboxE2e, WhatStartsWorkersIsStartedAgainAndEndsWithTheService) {
  Start({});
  ASSERT_EQ(Run("hills.asc")["status"], "successful");
  const std::set<int> first = Spawners();
  ASSERT_EQ(first.size(), 1U);
  ::kill(*first.begin(), SIGKILL);
  EXPECT_EQ(Run("hills.asc")["status"], "successful");
  const std::set<int> second = Spawners();
  ASSERT_EQ(second.size(), 1U);
  EXPECT_NE(first, second);
  service_->Signal(SIGKILL);
  // A process that has ended, whether anybody waits for it or not, has no program.
  const auto runs = [&second] {
    std::error_code failure;
    const std::string process = "/proc/" + std::to_string(*second.begin());
    return !std::filesystem::read_symlink(process + "/exe", failure).empty() && !failure;
  };
  for (int tries = 0; tries < 500 && runs(); ++tries) {
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
  }
  EXPECT_FALSE(runs());
}

TEST_F(SandboxE2e, APipeForAManifestFailsTheJobAlone) {
  StartStandIn();
  EXPECT_EQ(Run("pipe.asc")["exception"]["code"], "worker-crashed");
  EXPECT_EQ(Run("good.asc")["status"], "successful");
}

TEST_F(SandboxE2e, OurOwnWorkerDoesItsJobInAllLayers) {
  Start({"FARHORIZON_WORKER_THREADS=2"});
  const json info =
      Run("hills.asc", "crs=EPSG:4326%2B5773&formats=3dtiles,drc,geojson,flatgeobuf,geopackage");
  EXPECT_EQ(info["status"], "successful") << info;
}

TEST_F(SandboxE2e, LayersThatAreRequiredAreThereOrTheServiceDoesNotStart) {
  EXPECT_EQ(Refused({"FARHORIZON_SANDBOX_REQUIRE=everything"}), 2);
  EXPECT_THAT(SlurpFile(folder_ / "log"), HasSubstr("\"everything\" is no layer"));
  Start({});
  const std::string log = SlurpFile(folder_ / "log");
  const bool all = HasLayer("namespaces,private-root,landlock,seccomp");
  service_.reset();
  std::filesystem::remove(folder_ / "log");
  if (all) {
    Start({"FARHORIZON_SANDBOX_REQUIRE=all"});
  } else {
    EXPECT_EQ(Refused({"FARHORIZON_SANDBOX_REQUIRE=all"}), 1) << log;
    EXPECT_THAT(SlurpFile(folder_ / "log"), HasSubstr("cannot be had here"));
  }
}

TEST_F(SandboxE2e, AWorkerProgramThatCannotRunIsRefusedAtTheStart) {
  SpillFile(folder_ / "text", "no program");
  for (const std::string& program :
       {(folder_ / "missing").string(), (folder_ / "text").string(), folder_.path().string()}) {
    std::filesystem::remove(folder_ / "log");
    EXPECT_EQ(Refused({"FARHORIZON_WORKER_PROGRAM=" + program}), 1) << program;
    EXPECT_THAT(SlurpFile(folder_ / "log"), HasSubstr("worker.program")) << program;
  }
}

}  // namespace
}  // namespace farhorizon
