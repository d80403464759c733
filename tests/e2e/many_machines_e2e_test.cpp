// Services and a worker of the real program on one database and one folder of objects. Skipped
// where Debian's postgresql-15 is not installed.
#include <algorithm>
#include <csignal>

#include "tests/support/machines_fixture.h"

namespace farhorizon {
namespace {

using nlohmann::json;

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
  const std::string id = Submit("ada", "good.asc");
  ASSERT_EQ(WaitForEnd("ada", id), "successful");
  std::filesystem::rename(folder_ / "objects", folder_ / "away");
  std::this_thread::sleep_for(std::chrono::seconds(1));  // longer than an answer is good for
  EXPECT_EQ(Ask(machines_["ada"].port, "GET", "/readyz").status, 503);
  const RawAnswer refused = Send("ada", "good.asc");
  EXPECT_EQ(refused.status, 503) << refused.body;
  EXPECT_NE(refused.head.find("Retry-After"), std::string::npos) << refused.head;
  EXPECT_EQ(Ask(machines_["ada"].port, "GET", "/jobs/" + id + "/results/report.json").status, 503);
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
