// The store of the real program, as a disk, an operator and an accident meet it.
#include <algorithm>
#include <signal.h>
#include <string>
#include <sys/stat.h>
#include <vector>

#include "tests/support/service_fixture.h"

namespace farhorizon {
namespace {

using nlohmann::json;

class StoreE2e : public ServiceE2e {
 protected:
  [[nodiscard]] std::filesystem::path Data() const { return folder_ / "data"; }
  /// The file of an artifact.
  std::filesystem::path ObjectOf(const std::string& job, const std::string& name) {
    const json results = json::parse(Ask(port_, "GET", job + "/results").body);
    const std::string sha = results[name].value("sha256", "");
    const auto kept = Data() / "objects" / sha.substr(0, 2) / sha;
    for (int tries = 0; tries < 100 && !std::filesystem::exists(kept); ++tries) {
      std::this_thread::sleep_for(std::chrono::milliseconds(50));
    }
    return kept;
  }
  static void Flip(const std::filesystem::path& file) {
    std::filesystem::permissions(file, std::filesystem::perms::owner_all);
    std::string bytes = SlurpFile(file);
    bytes[bytes.size() / 2] = static_cast<char>(bytes[bytes.size() / 2] ^ 1);
    SpillFile(file, bytes);
  }
};

TEST_F(StoreE2e, ADamagedResultIsToldAndHealsWhenTheDemComesAgain) {
  StartStandIn();
  const std::string job = Submit("good.asc");
  ASSERT_EQ(WaitForEnd(job), "successful");
  const std::string report = job + "/results/report.json";
  ASSERT_EQ(Ask(port_, "GET", report).status, 200);
  Flip(ObjectOf(job, "report.json"));
  for (const char* range : {"", "Range: bytes=0-0\r\n"}) {
    const RawAnswer damaged = Ask(port_, "GET", report, range);
    EXPECT_EQ(damaged.status, 500);
    EXPECT_EQ(json::parse(damaged.body)["code"], "result-corrupt");
  }
  EXPECT_EQ(Ask(port_, "GET", job + "/results/manifest.json").status, 200);
  ASSERT_EQ(WaitForEnd(Submit("good.asc")), "successful");
  const RawAnswer healed = Ask(port_, "GET", report, "Range: bytes=1-13\r\n");
  EXPECT_EQ(healed.status, 206);
  EXPECT_EQ(healed.body, "\"descriptors\"");
}

TEST_F(StoreE2e, ALimitOfTheFileSizeIsAFullDisk) {
  // In blocks of 512 bytes: more than the database needs, less than the upload has.
  std::vector<std::string> words = {"/bin/sh", "-c", "ulimit -f 2000; exec \"$@\"", "sh"};
  for (const std::string& word : Command()) words.push_back(word);
  service_ = std::make_unique<Process>(words, std::vector<std::string>{}, folder_ / "log");
  port_ = PortOf(folder_ / "log");
  ASSERT_NE(port_, 0);
  const RawAnswer large = Ask(port_, "POST", "/jobs", "Content-Type: image/tiff\r\n",
                              "II*" + std::string(2'000'000, '\0'));
  EXPECT_EQ(large.status, 507) << large.body;
  EXPECT_EQ(json::parse(large.body)["code"], "no-space");
  EXPECT_EQ(Ask(port_, "GET", "/jobs").status, 200);
}

TEST_F(StoreE2e, ASyncThatFailsEndsTheServiceAndNothingIsLost) {
#if defined(__SANITIZE_ADDRESS__)
  GTEST_SKIP() << "AddressSanitizer must be the first library";
#endif
  const std::filesystem::path broken = folder_ / "broken";
  StartStandIn({std::string("LD_PRELOAD=") + FAILING_SYNC, "FAILING_SYNC=" + broken.string()});
  const std::string done = Submit("good.asc");
  ASSERT_EQ(WaitForEnd(done), "successful");
  const std::string running = Submit("slow.asc");
  ASSERT_EQ(WaitFor(running, {"running"}), "running");
  SpillFile(broken, "");
  EXPECT_NE(Ask(port_, "POST", "/jobs?crs=EPSG:4326&filename=a.asc", "Content-Type: text/plain\r\n",
                SmallGrid())
                .status,
            201);
  EXPECT_EQ(service_->Wait(), 74);
  EXPECT_THAT(SlurpFile(folder_ / "log"), testing::HasSubstr("the disk failed to keep"));
  StartStandIn();
  EXPECT_EQ(StatusOf(done)["status"], "successful");
  EXPECT_EQ(WaitForEnd(running), "successful");
  EXPECT_EQ(StatusOf(running)["attempt"], 1) << "a fault of the machine spends none";
}

TEST_F(StoreE2e, NothingOfTheDataIsForOtherUsers) {
  StartStandIn();
  ASSERT_EQ(WaitForEnd(Submit("good.asc")), "successful");
  for (const auto& entry : std::filesystem::recursive_directory_iterator(folder_ / "data")) {
    const auto mode = std::filesystem::status(entry.path()).permissions();
    EXPECT_EQ(mode & (std::filesystem::perms::group_all | std::filesystem::perms::others_all),
              std::filesystem::perms::none)
        << entry.path();
  }
}

TEST_F(StoreE2e, RefusesAFolderThatIsNotItsOwnersAlone) {
  std::filesystem::create_directories(Data());
  ::chmod(Data().c_str(), 0777);
  EXPECT_EQ(Run({"serve", "--listen", "127.0.0.1:0", "--data", Data().string()}), 1);
  EXPECT_THAT(SlurpFile(folder_ / "stderr"), testing::HasSubstr("chmod -R go-rwx"));
}

TEST_F(StoreE2e, FsckSaysWhatIsWrongAndMendsIt) {
  StartStandIn();
  const std::string job = Submit("good.asc");
  ASSERT_EQ(WaitForEnd(job), "successful");
  const std::filesystem::path result = ObjectOf(job, "report.json");
  EXPECT_EQ(Run({"fsck", Data().string()}), 1) << "the service runs";
  service_->Signal(SIGTERM);
  ASSERT_EQ(service_->Wait(), 0);
  EXPECT_EQ(Run({"fsck", "--data", Data().string()}), 0) << SlurpFile(folder_ / "stderr");
  EXPECT_THAT(SlurpFile(folder_ / "stderr"), testing::HasSubstr("1 jobs, 3 objects"));
  Flip(result);
  EXPECT_EQ(Run({"fsck", Data().string()}), 1);
  EXPECT_EQ(Run({"fsck", Data().string(), "--repair"}), 1);
  EXPECT_EQ(Run({"fsck", Data().string()}), 0);
  StartStandIn();
  EXPECT_EQ(WaitForEnd(job), "successful") << "it ran again";
  EXPECT_EQ(Ask(port_, "GET", job + "/results/report.json").status, 200);
}

TEST_F(StoreE2e, AStoppedWorkerIsNoticedAndItsJobRunsAgain) {
  StartStandIn({"FARHORIZON_WORKERS=1"});
  const std::string job = Submit("stopped.asc");
  const auto deadline = std::chrono::steady_clock::now() + std::chrono::seconds(60);
  while (StatusOf(job).value("attempt", 0) < 2 && std::chrono::steady_clock::now() < deadline) {
    std::this_thread::sleep_for(std::chrono::milliseconds(50));
  }
  EXPECT_EQ(StatusOf(job).value("attempt", 0), 2);
  EXPECT_EQ(Ask(port_, "DELETE", job).status, 200);
  EXPECT_EQ(WaitForEnd(Submit("good.asc")), "successful") << "the slot is free";
}

TEST_F(StoreE2e, TermIsQuickAndSpendsNoAttempt) {
  StartStandIn({"FARHORIZON_WORKERS=1", "FARHORIZON_JOBS_DRAIN_SECONDS=0"});
  const std::string job = Submit("slow.asc");
  ASSERT_EQ(WaitFor(job, {"running"}), "running");
  service_->Signal(SIGTERM);
  EXPECT_EQ(service_->Wait(std::chrono::seconds(10)), 0);
  StartStandIn();
  EXPECT_EQ(WaitForEnd(job), "successful");
  EXPECT_EQ(StatusOf(job)["attempt"], 1);
}

TEST_F(StoreE2e, AServiceThatDiesOfAJobThreeTimesFailsIt) {
  for (int start = 0; start < 3; ++start) {
    // A sanitizer's handler takes locks that a thread may hold when the signal comes.
    StartStandIn({"FARHORIZON_WORKERS=1", "ASAN_OPTIONS=handle_segv=0"});
    const std::string job =
        start == 0
            ? Submit("hang.asc")
            : "/jobs/" + json::parse(Ask(port_, "GET", "/jobs").body)["jobs"][0].value("jobID", "");
    ASSERT_EQ(WaitFor(job, {"running"}), "running");
    service_->Signal(SIGSEGV);
    ASSERT_EQ(service_->Wait(), 128 + SIGSEGV);
  }
  StartStandIn();
  const json ended = json::parse(Ask(port_, "GET", "/jobs").body)["jobs"][0];
  EXPECT_EQ(ended["status"], "failed");
  EXPECT_EQ(ended["exception"]["code"], "poison-job");
}

TEST_F(StoreE2e, OneClientAloneDoesNotFillTheQueue) {
  StartStandIn({"FARHORIZON_WORKERS=1", "FARHORIZON_JOBS_MAX_WAITING_PER_CLIENT=2"});
  ASSERT_EQ(WaitFor(Submit("hang.asc"), {"running"}), "running");
  for (int i = 0; i < 2; ++i) Submit("good.asc");
  const RawAnswer refused = Ask(port_, "POST", "/jobs?crs=EPSG:4326&filename=a.asc",
                                "Content-Type: text/plain\r\n", SmallGrid());
  EXPECT_EQ(refused.status, 429);
  EXPECT_EQ(json::parse(refused.body)["code"], "too-many-jobs");
  EXPECT_THAT(refused.head, testing::HasSubstr("Retry-After: "));
}

}  // namespace
}  // namespace farhorizon
