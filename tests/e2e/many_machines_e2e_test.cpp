// Services and a worker of the real program on one database and one folder of objects. Skipped
// where Debian's postgresql-15 is not installed.
#include <algorithm>
#include <csignal>
#include <map>
#include <optional>

#include "tests/support/postgres_server.h"
#include "tests/support/service_fixture.h"

namespace farhorizon {
namespace {

using nlohmann::json;

class ManyMachinesE2e : public testing::Test {
 protected:
  struct Machine {
    std::unique_ptr<Process> process;
    std::uint16_t port = 0;
  };

  void SetUp() override {
    if (!PostgresServer::IsInstalled()) GTEST_SKIP() << "no postgresql-15";
    server_ = std::make_unique<PostgresServer>();
    url_ = server_->NewDatabase();
  }
  // role: "serve" or "work". Each process has a data folder of its own, named as it is.
  void Start(const std::string& name, const std::string& role) {
    const std::vector<std::string> words = {FARHORIZON_PROGRAM, role,
                                            "--listen",         "127.0.0.1:0",
                                            "--data",           (folder_ / name).string(),
                                            "--workers",        "1",
                                            "--database",       url_,
                                            "--objects",        (folder_ / "objects").string()};
    const std::vector<std::string> settings = {
        std::string("FARHORIZON_WORKER_PROGRAM=") + STAND_IN_WORKER,
        "FARHORIZON_STORE_LEASE_SECONDS=3"};
    Machine& machine = machines_[name];
    machine.process = std::make_unique<Process>(words, settings, LogOf(name));
    machine.port = PortOf(LogOf(name));
    ASSERT_NE(machine.port, 0) << SlurpFile(LogOf(name));
  }
  [[nodiscard]] std::filesystem::path LogOf(const std::string& name) const {
    return folder_ / (name + ".log");
  }
  RawAnswer Send(const std::string& name, const std::string& file,
                 const std::string& headers = "") {
    return Ask(machines_[name].port, "POST", "/jobs?crs=EPSG:4326&filename=" + file,
               "Content-Type: application/octet-stream\r\n" + headers, SmallGrid());
  }
  std::string Submit(const std::string& name, const std::string& file) {
    const RawAnswer answer = Send(name, file);
    EXPECT_EQ(answer.status, 201) << answer.head << answer.body;
    return answer.status == 201 ? json::parse(answer.body).value("jobID", "") : "";
  }
  std::string StateOf(const std::string& name, const std::string& id) {
    const RawAnswer answer = Ask(machines_[name].port, "GET", "/jobs/" + id);
    return answer.status == 200 ? json::parse(answer.body).value("status", "") : "";
  }
  std::string WaitForEnd(const std::string& name, const std::string& id) {
    std::string state;
    for (int tries = 0; tries < 1200; ++tries) {
      state = StateOf(name, id);
      if (state != "accepted" && state != "running" && !state.empty()) break;
      std::this_thread::sleep_for(std::chrono::milliseconds(50));
    }
    return state;
  }
  // How many lines of a process's log have this message, of this job.
  [[nodiscard]] int Said(const std::string& name, const std::string& message,
                         const std::string& id) const {
    std::ifstream log(LogOf(name));
    int count = 0;
    for (std::string line; std::getline(log, line);) {
      const json entry = json::parse(line, nullptr, false);
      if (!entry.is_object() || entry.value("msg", "") != message) continue;
      count += entry.value("job_id", "") == id ? 1 : 0;
    }
    return count;
  }
  // The process that runs the job; "" where none has begun within half a minute.
  std::string RunnerOf(const std::string& id) {
    for (int tries = 0; tries < 600; ++tries) {
      for (const auto& [name, machine] : machines_) {
        if (machine.process && Said(name, "job starts", id) > 0) return name;
      }
      std::this_thread::sleep_for(std::chrono::milliseconds(50));
    }
    return "";
  }
  void Kill(const std::string& name) {
    Process& process = *machines_[name].process;
    process.Signal(SIGKILL);
    EXPECT_EQ(process.Wait(), 128 + SIGKILL);
    machines_[name].process.reset();
  }
  int SuccessesOf(const std::string& id) {
    int count = 0;
    for (const auto& [name, machine] : machines_) count += Said(name, "job successful", id);
    return count;
  }
  // A process that still serves.
  std::string Server() {
    for (const auto& [name, machine] : machines_) {
      if (machine.process && name != "worker") return name;
    }
    return "";
  }

  TempDir folder_;
  std::unique_ptr<PostgresServer> server_;
  std::string url_;
  std::map<std::string, Machine> machines_;
};

TEST_F(ManyMachinesE2e, AKilledProcessCostsALeaseAndItsJobEndsSuccessfulOnce) {
  Start("ada", "serve");
  Start("bob", "serve");
  Start("worker", "work");
  const std::string seen = Submit("ada", "good.asc");
  EXPECT_EQ(WaitForEnd("bob", seen), "successful");
  const RawAnswer report =
      Ask(machines_["bob"].port, "GET", "/jobs/" + seen + "/results/report.json");
  EXPECT_EQ(report.status, 200) << report.body;

  const std::string id = Submit("ada", "slow.asc");
  const std::string runner = RunnerOf(id);
  ASSERT_NE(runner, "");
  Kill(runner);
  const std::string left = Server();
  EXPECT_EQ(WaitForEnd(left, id), "successful");
  EXPECT_EQ(Said(runner, "job successful", id), 0) << "it was killed too late";
  EXPECT_EQ(SuccessesOf(id), 1);
  EXPECT_EQ(Ask(machines_[left].port, "GET", "/jobs/" + id + "/results/report.json").status, 200);
}

TEST_F(ManyMachinesE2e, AnUploadGoesOnAtAnotherMachine) {
  Start("ada", "serve");
  Start("bob", "serve");
  const std::string dem = SmallGrid();
  const std::string tus = "Tus-Resumable: 1.0.0\r\n";
  const RawAnswer made = Ask(machines_["ada"].port, "POST", "/uploads",
                             tus + "Upload-Length: " + std::to_string(dem.size()) + "\r\n");
  ASSERT_EQ(made.status, 201) << made.body;
  const std::size_t at = made.head.find("/uploads/");
  const std::string path = made.head.substr(at, made.head.find("\r\n", at) - at);
  const auto patch = [&](const std::string& name, std::size_t offset, const std::string& body) {
    return Ask(machines_[name].port, "PATCH", path,
               tus + "Content-Type: application/offset+octet-stream\r\nUpload-Offset: " +
                   std::to_string(offset) + "\r\n",
               body)
        .status;
  };
  EXPECT_EQ(patch("ada", 0, dem.substr(0, 300)), 204);
  EXPECT_EQ(patch("bob", 300, dem.substr(300, 300)), 204);
  EXPECT_EQ(patch("ada", 300, dem.substr(300)), 409);
  Kill("ada");
  EXPECT_EQ(patch("bob", 600, dem.substr(600)), 204);
  const json body = {
      {"inputs", {{"dem", {{"href", path}}}, {"crs", "EPSG:4326"}, {"filename", "good.asc"}}}};
  const RawAnswer job = Ask(machines_["bob"].port, "POST", "/jobs",
                            "Content-Type: application/json\r\n", body.dump());
  ASSERT_EQ(job.status, 201) << job.body;
  EXPECT_EQ(WaitForEnd("bob", json::parse(job.body).value("jobID", "")), "successful");
}

TEST_F(ManyMachinesE2e, AFrozenProcessLosesItsJobAndStoresNothingWhenItGoesOn) {
  Start("ada", "serve");
  Start("worker", "work");
  const std::string id = Submit("ada", "slow.asc");
  const std::string runner = RunnerOf(id);
  ASSERT_NE(runner, "");
  machines_[runner].process->Signal(SIGSTOP);
  if (runner == "ada") Start("bob", "serve");
  const std::string asked = runner == "ada" ? "bob" : "ada";
  EXPECT_EQ(WaitForEnd(asked, id), "successful");
  const std::string before = Ask(machines_[asked].port, "GET", "/jobs/" + id).body;
  machines_[runner].process->Signal(SIGCONT);
  std::this_thread::sleep_for(std::chrono::seconds(4));
  EXPECT_EQ(Said(runner, "job successful", id), 0);
  EXPECT_EQ(SuccessesOf(id), 1);
  EXPECT_EQ(Ask(machines_[asked].port, "GET", "/jobs/" + id).body, before);
}

TEST_F(ManyMachinesE2e, ADismissalAtOneStopsTheWorkerOfAnother) {
  Start("ada", "serve");
  Start("worker", "work");
  const std::string id = Submit("ada", "hang.asc");
  const std::string runner = RunnerOf(id);
  ASSERT_NE(runner, "");
  EXPECT_EQ(Ask(machines_["ada"].port, "DELETE", "/jobs/" + id).status, 200);
  EXPECT_EQ(StateOf("ada", id), "dismissed");
  // Its only slot is free again.
  for (int tries = 0; tries < 200 && Said(runner, "job stopped", id) == 0; ++tries) {
    std::this_thread::sleep_for(std::chrono::milliseconds(50));
  }
  EXPECT_EQ(Said(runner, "job stopped", id), 1);
  EXPECT_EQ(WaitForEnd("ada", Submit("ada", "good.asc")), "successful");
}

TEST_F(ManyMachinesE2e, ADatabaseThatIsDownIs503AndNothingIsLost) {
  Start("ada", "serve");
  const std::string before = Submit("ada", "good.asc");
  ASSERT_EQ(WaitForEnd("ada", before), "successful");
  server_->Crash();
  const RawAnswer refused = Send("ada", "good.asc", "Idempotency-Key: \"k\"\r\n");
  EXPECT_EQ(refused.status, 503) << refused.body;
  EXPECT_NE(refused.head.find("Retry-After"), std::string::npos) << refused.head;
  EXPECT_EQ(Ask(machines_["ada"].port, "GET", "/readyz").status, 503);
  EXPECT_EQ(Ask(machines_["ada"].port, "GET", "/healthz").status, 200);
  server_->Start();
  std::string id;
  for (int tries = 0; tries < 200 && id.empty(); ++tries) {
    const RawAnswer answer = Send("ada", "good.asc", "Idempotency-Key: \"k\"\r\n");
    if (answer.status == 201) id = json::parse(answer.body).value("jobID", "");
    std::this_thread::sleep_for(std::chrono::milliseconds(100));
  }
  EXPECT_EQ(WaitForEnd("ada", id), "successful");
  EXPECT_EQ(StateOf("ada", before), "successful");
}

TEST_F(ManyMachinesE2e, IsNotReadyWithoutTheFolderOfObjects) {
  Start("ada", "serve");
  EXPECT_EQ(Ask(machines_["ada"].port, "GET", "/readyz").status, 200);
  std::filesystem::rename(folder_ / "objects", folder_ / "away");
  std::this_thread::sleep_for(std::chrono::seconds(1));  // longer than an answer is good for
  EXPECT_EQ(Ask(machines_["ada"].port, "GET", "/readyz").status, 503);
  std::filesystem::rename(folder_ / "away", folder_ / "objects");
  std::this_thread::sleep_for(std::chrono::seconds(1));
  EXPECT_EQ(Ask(machines_["ada"].port, "GET", "/readyz").status, 200);
  EXPECT_EQ(WaitForEnd("ada", Submit("ada", "good.asc")), "successful");
}

TEST_F(ManyMachinesE2e, AWorkerAnswersOfHealthAndMetricsAndNothingElse) {
  Start("worker", "work");
  const std::uint16_t port = machines_["worker"].port;
  EXPECT_EQ(Ask(port, "GET", "/readyz").status, 200);
  EXPECT_EQ(Ask(port, "GET", "/metrics").status, 200);
  EXPECT_EQ(Ask(port, "GET", "/jobs").status, 404);
  EXPECT_EQ(Send("worker", "good.asc").status, 404);
  machines_["worker"].process->Signal(SIGTERM);
  EXPECT_EQ(machines_["worker"].process->Wait(), 0);
}

TEST_F(ManyMachinesE2e, AWorkerWithoutASharedStoreIsACallAtFault) {
  Process alone({FARHORIZON_PROGRAM, "work", "--data", (folder_ / "x").string()}, {},
                LogOf("alone"));
  EXPECT_EQ(alone.Wait(), 2);
  EXPECT_NE(SlurpFile(LogOf("alone")).find("--database"), std::string::npos);
}

}  // namespace
}  // namespace farhorizon
