#pragma once

#include <algorithm>
#include <csignal>
#include <fstream>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "tests/support/postgres_server.h"
#include "tests/support/service_fixture.h"

namespace farhorizon {

/// Processes of the real program on one PostgreSQL server, with the stand-in for workers.
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
  /// The words that start a process, which has a data folder of its own, named as it is.
  /// role: "serve" or "work".
  [[nodiscard]] std::vector<std::string> Command(const std::string& name,
                                                 const std::string& role) const {
    return {FARHORIZON_PROGRAM, role,
            "--listen",         "127.0.0.1:0",
            "--data",           (folder_ / name).string(),
            "--workers",        "1",
            "--database",       url_,
            "--objects",        objects_};
  }
  [[nodiscard]] std::vector<std::string> Settings() const {
    std::vector<std::string> settings = environment_;
    settings.push_back(std::string("FARHORIZON_WORKER_PROGRAM=") + STAND_IN_WORKER);
    settings.emplace_back("FARHORIZON_STORE_LEASE_SECONDS=3");
    return settings;
  }
  void Start(const std::string& name, const std::string& role) {
    Machine& machine = machines_[name];
    machine.process = std::make_unique<Process>(Command(name, role), Settings(), LogOf(name));
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
    return answer.status == 201 ? nlohmann::json::parse(answer.body).value("jobID", "") : "";
  }
  std::string StateOf(const std::string& name, const std::string& id) {
    const RawAnswer answer = Ask(machines_[name].port, "GET", "/jobs/" + id);
    return answer.status == 200 ? nlohmann::json::parse(answer.body).value("status", "") : "";
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
  /// How many lines of a process's log have this message, of this job.
  [[nodiscard]] int Said(const std::string& name, const std::string& message,
                         const std::string& id) const {
    std::ifstream log(LogOf(name));
    int count = 0;
    for (std::string line; std::getline(log, line);) {
      const nlohmann::json entry = nlohmann::json::parse(line, nullptr, false);
      if (!entry.is_object() || entry.value("msg", "") != message) continue;
      count += entry.value("job_id", "") == id ? 1 : 0;
    }
    return count;
  }
  /// The process that runs the job; "" where none has begun within half a minute.
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
  /// A process that still serves.
  std::string Server() {
    for (const auto& [name, machine] : machines_) {
      if (machine.process && name != "worker") return name;
    }
    return "";
  }

  TempDir folder_;
  std::unique_ptr<PostgresServer> server_;
  std::string url_;
  std::string objects_ = (folder_ / "objects").string();
  std::vector<std::string> environment_;  // of each process, beside the test's own
  std::map<std::string, Machine> machines_;
};

}  // namespace farhorizon
