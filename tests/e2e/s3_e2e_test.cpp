// Services of the real program on one database and one bucket, whose server fails, stands still and
// is slow; and stores that do not belong together. Skipped where postgresql-15 or python3 is
// missing.
#include <sys/stat.h>

#include "tests/support/machines_fixture.h"
#include "tests/support/s3_server.h"

namespace farhorizon {
namespace {

using nlohmann::json;
using testing::HasSubstr;
using testing::Not;

class S3E2e : public ManyMachinesE2e {
 protected:
  void SetUp() override {
    ManyMachinesE2e::SetUp();
    if (IsSkipped()) return;
    if (!S3Server::IsInstalled()) GTEST_SKIP() << "no python3";
    bucket_ = std::make_unique<S3Server>();
    objects_ = "s3://tests/of/these";
    environment_ = bucket_->Environment();
  }
  RawAnswer ReportOf(const std::string& name, const std::string& id) {
    return Ask(machines_[name].port, "GET", "/jobs/" + id + "/results/report.json");
  }
  // Sends until it is taken.
  std::string SubmitSurely(const std::string& name, const std::string& file) {
    for (int tries = 0; tries < 200; ++tries) {
      const RawAnswer answer = Send(name, file, "Idempotency-Key: \"k\"\r\n");
      if (answer.status == 201) return json::parse(answer.body).value("jobID", "");
      EXPECT_EQ(answer.status, 503) << answer.body;
      std::this_thread::sleep_for(std::chrono::milliseconds(100));
    }
    return "";
  }
  // What a start says that fails, and with which status.
  std::pair<int, std::string> Refusal(const std::vector<std::string>& words) {
    const auto log = folder_ / ("refusal" + std::to_string(refusals_++));
    Process process(words, Settings(), log);
    const int status = process.Wait();
    return {status, SlurpFile(log)};
  }

  std::unique_ptr<S3Server> bucket_;
  int refusals_ = 0;
};

TEST_F(S3E2e, AJobSentToOneIsServedByAnotherAndSurvivesAKill) {
  Start("ada", "serve");
  Start("bob", "serve");
  Start("worker", "work");
  const std::string seen = Submit("ada", "good.asc");
  EXPECT_EQ(WaitForEnd("bob", seen), "successful");
  EXPECT_EQ(ReportOf("bob", seen).status, 200);
  EXPECT_EQ(ReportOf("ada", seen).body, ReportOf("bob", seen).body);
  EXPECT_EQ(Ask(machines_["bob"].port, "GET", "/jobs/" + seen + "/results/report.json",
                "Range: bytes=1-2\r\n")
                .status,
            206);

  const std::string id = Submit("ada", "slow.asc");
  const std::string runner = RunnerOf(id);
  ASSERT_NE(runner, "");
  Kill(runner);
  const std::string left = Server();
  EXPECT_EQ(WaitForEnd(left, id), "successful");
  EXPECT_EQ(SuccessesOf(id), 1);
  EXPECT_EQ(ReportOf(left, id).status, 200);
  for (const std::string& file : bucket_->Files()) EXPECT_THAT(file, Not(HasSubstr("incoming")));
}

TEST_F(S3E2e, AStorageThatIsDownIs503AndNothingIsLost) {
  Start("ada", "serve");
  Start("bob", "serve");
  const std::string before = Submit("ada", "good.asc");
  ASSERT_EQ(WaitForEnd("ada", before), "successful");
  const std::string runner = RunnerOf(before);
  bucket_->Kill();
  const RawAnswer refused = Send("ada", "good.asc", "Idempotency-Key: \"k\"\r\n");
  EXPECT_EQ(refused.status, 503) << refused.body;
  EXPECT_THAT(refused.head, HasSubstr("Retry-After"));
  EXPECT_THAT(refused.body, HasSubstr("\"storage\""));
  // Whoever ran the job has a copy of its results; the other one has none, and says so.
  const std::string other = runner == "ada" ? "bob" : "ada";
  EXPECT_EQ(ReportOf(runner, before).status, 200);
  EXPECT_EQ(ReportOf(other, before).status, 503);
  EXPECT_EQ(StateOf(other, before), "successful");
  EXPECT_EQ(Ask(machines_[other].port, "GET", "/healthz").status, 200);
  for (int tries = 0; tries < 120; ++tries) {
    if (Ask(machines_["ada"].port, "GET", "/readyz").status == 503) break;
    std::this_thread::sleep_for(std::chrono::milliseconds(100));
  }
  EXPECT_EQ(Ask(machines_["ada"].port, "GET", "/readyz").status, 503);
  bucket_->Start();
  EXPECT_EQ(WaitForEnd("ada", SubmitSurely("ada", "good.asc")), "successful");
  EXPECT_EQ(ReportOf(other, before).status, 200);
  EXPECT_EQ(Ask(machines_["ada"].port, "GET", "/readyz").status, 200);
}

TEST_F(S3E2e, AJobWhoseResultsCannotBeStoredRunsAgainAndSpendsNoAttempt) {
  Start("ada", "serve");
  const std::string id = Submit("ada", "slow.asc");
  ASSERT_EQ(RunnerOf(id), "ada");
  bucket_->SetFaults(R"({"status": 500, "only": "PUT"})");
  for (int tries = 0; tries < 600; ++tries) {
    if (Said("ada", "the machine is at fault: the job runs again later", id) > 0) break;
    std::this_thread::sleep_for(std::chrono::milliseconds(50));
  }
  EXPECT_GT(Said("ada", "the machine is at fault: the job runs again later", id), 0);
  bucket_->SetFaults("{}");
  EXPECT_EQ(WaitForEnd("ada", id), "successful");
  EXPECT_EQ(Said("ada", "job failed", id), 0);
  EXPECT_EQ(ReportOf("ada", id).status, 200);
}

TEST_F(S3E2e, ASlowStorageCostsTimeAlone) {
  bucket_->SetFaults(R"({"stall": 0.3})");
  Start("ada", "serve");
  EXPECT_EQ(WaitForEnd("ada", Submit("ada", "good.asc")), "successful");
}

TEST_F(S3E2e, StoresThatDoNotBelongTogetherAreRefused) {
  Start("ada", "serve");
  // One database, and other objects: a prefix, a folder.
  for (const std::string& other : {std::string("s3://tests/others"), (folder_ / "f").string()}) {
    objects_ = other;
    const auto [status, words] = Refusal(Command("bob", "serve"));
    EXPECT_EQ(status, 1) << words;
    EXPECT_THAT(words, HasSubstr("used with others before"));
  }
  // One bucket, and another database.
  objects_ = "s3://tests/of/these";
  url_ = server_->NewDatabase();
  const auto [status, words] = Refusal(Command("bob", "serve"));
  EXPECT_EQ(status, 1) << words;
  EXPECT_THAT(words, HasSubstr("belong to another database"));
}

TEST_F(S3E2e, OfTwoFirstStartsAtOnceWithOtherObjectsOneIsRefused) {
  const std::vector<std::string> ada = Command("ada", "serve");
  objects_ = "s3://tests/others";
  const std::vector<std::string> bob = Command("bob", "serve");
  Process one(ada, Settings(), LogOf("ada"));
  Process two(bob, Settings(), LogOf("bob"));
  const auto says = [&](const std::string& name, const std::string& words) {
    return std::filesystem::exists(LogOf(name)) &&
           SlurpFile(LogOf(name)).find(words) != std::string::npos;
  };
  const auto both = [&](const std::string& serving, const std::string& refused) {
    return says(serving, "\"serving\"") && says(refused, "used with others before");
  };
  for (int tries = 0; tries < 400 && !both("ada", "bob") && !both("bob", "ada"); ++tries) {
    std::this_thread::sleep_for(std::chrono::milliseconds(50));
  }
  EXPECT_NE(both("ada", "bob"), both("bob", "ada"))
      << SlurpFile(LogOf("ada")) << SlurpFile(LogOf("bob"));
}

TEST_F(S3E2e, ACallThatIsAtFaultIsSaidBeforeAnythingStarts) {
  const auto refused = [&](const std::string& database, const std::string& objects) {
    url_ = database;
    objects_ = objects;
    std::vector<std::string> words = Command("ada", "serve");
    const auto [status, said] = Refusal(words);
    words.emplace_back("--check-config");
    const auto [checked, ignored] = Refusal(words);
    EXPECT_EQ(status, 2) << said;
    EXPECT_EQ(checked, 2) << said;
    return said;
  };
  const std::string database = url_;
  EXPECT_THAT(refused("postgresql://u:hush@host:port:1/x", "s3://tests"),
              testing::AllOf(HasSubstr("store.jobs"), Not(HasSubstr("hush"))));
  EXPECT_THAT(refused("no url", "s3://tests"), HasSubstr("store.jobs"));
  EXPECT_THAT(refused(database, "s3://Tests"), HasSubstr("names no bucket"));
  EXPECT_THAT(refused(database, "s3://tests/../x"), HasSubstr("names no bucket"));
  EXPECT_THAT(refused(database, "gs://objects"), HasSubstr("store.objects"));
  EXPECT_THAT(refused(database, (folder_ / "ada" / ".").string()), HasSubstr("same folder"));
  environment_ = {"AWS_ENDPOINT_URL=ftp://x"};
  EXPECT_THAT(refused(database, "s3://tests"), HasSubstr("no endpoint"));
  environment_ = {"AWS_ENDPOINT_URL=http://x"};
  EXPECT_THAT(refused(database, "s3://tests"), HasSubstr("AWS_ACCESS_KEY_ID"));
}

TEST_F(S3E2e, SecretsAreInNoLogAndInNoEnvironmentOfAChild) {
  const std::string secret = "test/secret+of-the-store";
  Start("ada", "serve");
  const pid_t pid = machines_["ada"].process->pid();
  const std::string children = "/proc/" + std::to_string(pid) + "/task/" + std::to_string(pid);
  std::ifstream list(children + "/children");
  int count = 0;
  for (pid_t child = 0; list >> child; ++count) {
    const std::string environment = SlurpFile("/proc/" + std::to_string(child) + "/environ");
    EXPECT_THAT(environment, Not(HasSubstr("AWS_")));
  }
  EXPECT_GT(count, 0);
  bucket_->Kill();
  Send("ada", "good.asc");
  Ask(machines_["ada"].port, "GET", "/readyz");
  EXPECT_THAT(SlurpFile(LogOf("ada")), Not(HasSubstr(secret)));
}

}  // namespace
}  // namespace farhorizon
