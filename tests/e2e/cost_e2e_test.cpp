// What jobs cost: estimates before the 201, room for those that run, limits of time and disk.
#include <algorithm>
#include <atomic>
#include <chrono>
#include <map>
#include <sstream>
#include <string>
#include <thread>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "tests/support/service_fixture.h"

namespace farhorizon {
namespace {

using nlohmann::json;
using testing::HasSubstr;

#if defined(__SANITIZE_ADDRESS__)
constexpr bool kLimitsMemory = false;
#else
constexpr bool kLimitsMemory = true;
#endif

constexpr const char* kBinary = "Content-Type: application/octet-stream\r\n";

// Rough hills of `side` x `side` posts.
std::string Hills(int side) {
  std::string text = "ncols " + std::to_string(side) + "\nnrows " + std::to_string(side) +
                     "\nxllcorner 7\nyllcorner 46\ncellsize 0.001\n";
  for (int i = 0; i < side * side; ++i) {
    const int x = i % side;
    const int y = i / side;
    text +=
        std::to_string(500 + x * (side - x) / 40 + y * (side - y) / 30 + (x * 37 + y * 53) % 11);
    text += x + 1 == side ? '\n' : ' ';
  }
  return text;
}

class CostE2e : public ServiceE2e {
 protected:
  RawAnswer Post(const std::string& query, const std::string& body = SmallGrid()) {
    return Ask(port_, "POST", "/jobs?crs=EPSG:4326&" + query, kBinary, body);
  }
  static std::string CodeOf(const RawAnswer& answer) {
    return json::parse(answer.body).value("code", "");
  }
  // The number `field` of the log's line `message` about a job.
  std::int64_t Logged(const std::string& path, const std::string& message,
                      const std::string& field) {
    std::istringstream log(SlurpFile(folder_ / "log"));
    for (std::string line; std::getline(log, line);) {
      const json entry = json::parse(line, nullptr, false);
      if (!entry.is_object() || entry.value("msg", "") != message) continue;
      if ("/jobs/" + entry.value("job_id", "") == path) return entry.value(field, std::int64_t{0});
    }
    return 0;
  }
};

TEST_F(CostE2e, EstimatesHoldForWhatJobsTake) {
  if (!kLimitsMemory) GTEST_SKIP() << "a sanitizer takes memory of its own";
  Start({"FARHORIZON_WORKERS=1"});
  for (const int side : {33, 100, 200}) {
    const std::string job = Submit("a.asc&levels=2", "", Hills(side));
    ASSERT_EQ(WaitForEnd(job), "successful");
    const json info = StatusOf(job);
    EXPECT_EQ(info["attempt"], 1) << "it had memory enough";
    const std::int64_t expected = info["estimate"].value("memoryBytes", std::int64_t{0});
    EXPECT_EQ(Logged(job, "job starts", "memory_bytes"), expected);
    const std::int64_t peak = Logged(job, "job successful", "peak_bytes");
    EXPECT_GT(peak, 0);
    EXPECT_LE(peak, expected) << side;
    EXPECT_LE(expected, 3 * peak) << side;
  }
}

TEST_F(CostE2e, RefusesWithFiguresWhatNoWorkerMayHave) {
  Start({"FARHORIZON_WORKER_MEMORY_BYTES=134217728", "FARHORIZON_PROBE_MEMORY_BYTES=134217728",
         "FARHORIZON_PROBE_WALL_SECONDS=60", "FARHORIZON_WORKERS=1"});
  const RawAnswer answer = Post("filename=a.asc", Hills(450));
  EXPECT_EQ(answer.status, 422);
  const json problem = json::parse(answer.body);
  EXPECT_EQ(problem["code"], "memory-limit");
  EXPECT_THAT(problem.value("detail", ""), HasSubstr("202500 posts"));
  EXPECT_THAT(problem.value("detail", ""), HasSubstr("128 MiB"));
  EXPECT_EQ(json::parse(Ask(port_, "GET", "/jobs").body)["jobs"].size(), 0U);
  EXPECT_EQ(LeftOver("spool"), 0U);
  Submit("a.asc", "", Hills(50));
  if (!kLimitsMemory) return;
  // So many that a probe reads the header of the grid alone: it has no memory for the cells.
  std::string text = "ncols 4000\nnrows 4000\nxllcorner 7\nyllcorner 46\ncellsize 0.0001\n";
  for (int i = 0; i < 4000 * 4000; ++i) text += i % 2 == 0 ? "1 " : "2 ";
  const RawAnswer large = Post("filename=a.asc", text);
  EXPECT_EQ(large.status, 422);
  EXPECT_EQ(CodeOf(large), "memory-limit");
  EXPECT_THAT(large.body, HasSubstr("16000000 posts"));
}

TEST_F(CostE2e, WhatHasNoRoomBesideAnotherWaits) {
  // Nobody knows what these two cost: each has all that there is.
  StartStandIn({"FARHORIZON_WORKERS=2", "FARHORIZON_JOBS_MEMORY_BYTES=600000000"});
  const std::string first = Submit("slow1.asc");
  const std::string second = Submit("slow2.asc");
  for (bool ended = false; !ended;) {
    const std::string of_second = StatusOf(second).value("status", "");
    const std::string of_first = StatusOf(first).value("status", "");
    // The first was asked about later: where it still runs, the second cannot have begun.
    EXPECT_FALSE(of_second == "running" && of_first == "running");
    ended = of_second == "successful";
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
  }
}

TEST_F(CostE2e, AJobThatNeedsMoreThanWasExpectedRunsAgainWithMore) {
  StartStandIn({"FARHORIZON_WORKERS=1"});
  const std::string job = Submit("hungry.asc");
  const auto expected = StatusOf(job)["estimate"].value("memoryBytes", std::int64_t{0});
  ASSERT_EQ(WaitForEnd(job), "successful");
  if (!kLimitsMemory) GTEST_SKIP() << "a sanitizer takes memory of its own";
  EXPECT_EQ(StatusOf(job)["attempt"], 2);
  EXPECT_EQ(StatusOf(job)["estimate"]["memoryBytes"], 2 * expected);
}

TEST_F(CostE2e, AMachineThatIsTooSmallIsSaidAtTheStart) {
  Process service(Command(), {"FARHORIZON_JOBS_MEMORY_BYTES=50000000"}, folder_ / "log");
  EXPECT_EQ(service.Wait(std::chrono::seconds(60)), 2);
  EXPECT_THAT(SlurpFile(folder_ / "log"), HasSubstr("jobs.memoryBytes"));
}

TEST_F(CostE2e, PrioritiesDeadlinesAndTimeouts) {
  StartStandIn({"FARHORIZON_WORKERS=1"});
  const std::string holds = Submit("hang.asc");
  ASSERT_EQ(WaitFor(holds, {"running"}), "running");
  const std::string low = Submit("a.asc&priority=low");
  const std::string late = Submit("b.asc&deadline=1");
  const std::string high = Submit("c.asc&priority=high");
  EXPECT_EQ(WaitForEnd(late), "failed");
  const json missed = StatusOf(late);
  EXPECT_EQ(missed["exception"]["code"], "timeout");
  EXPECT_THAT(missed.value("message", ""), HasSubstr("1 seconds of its deadline"));
  EXPECT_FALSE(missed.contains("started"));
  EXPECT_EQ(Ask(port_, "DELETE", holds).status, 200);
  EXPECT_EQ(WaitForEnd(high), "successful");
  EXPECT_EQ(WaitForEnd(low), "successful");
  EXPECT_LT(StatusOf(high).value("started", ""), StatusOf(low).value("started", ""));

  const std::string endless = Submit("hang.asc&timeout=1");
  EXPECT_EQ(WaitForEnd(endless), "failed");
  EXPECT_THAT(StatusOf(endless).value("message", ""), HasSubstr("the timeout that came with it"));
  EXPECT_EQ(Post("priority=urgent").status, 400);
}

TEST_F(CostE2e, AWorkersFilesTogetherHaveALimit) {
  StartStandIn({"FARHORIZON_WORKER_FOLDER_BYTES=8388608"});
  const std::string job = Submit("folder.asc");
  EXPECT_EQ(WaitForEnd(job), "failed");
  EXPECT_EQ(FailureOf(job), "file-limit");
  EXPECT_THAT(StatusOf(job).value("message", ""), HasSubstr("8 MiB"));
  EXPECT_EQ(LeftOver("work"), 0U);
  const std::string blanks(9 << 20, ' ');
  EXPECT_EQ(WaitForEnd(Submit("slow.asc", "", SmallGrid() + blanks)), "successful")
      << "its input is no file of its own";
}

TEST_F(CostE2e, AProbeThatHangsEndsAtItsTimeAndOthersPassIt) {
  StartStandIn(
      {"FARHORIZON_WORKERS=1", "FARHORIZON_PROBE_AT_ONCE=2", "FARHORIZON_PROBE_WALL_SECONDS=3"});
  const std::string holds = Submit("hang.asc");
  std::atomic<bool> answered = false;
  std::thread hanging([&] {
    EXPECT_EQ(Post("filename=probe-hang.asc").status, 201) << "its job has more time";
    answered = true;
  });
  EXPECT_EQ(Post("filename=a.asc").status, 201);
  EXPECT_EQ(Ask(port_, "GET", "/healthz").status, 200);
  EXPECT_FALSE(answered) << "both came before it";
  hanging.join();
}

}  // namespace
}  // namespace farhorizon
