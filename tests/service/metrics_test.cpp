#include "service/metrics.h"

#include <functional>
#include <set>
#include <sstream>
#include <string>

#include <gtest/gtest.h>

namespace farhorizon {
namespace {

// The value of a metric; 0 where it is not there. Other tests of the process count, too.
double ValueOf(const std::string& metric) {
  std::istringstream lines(MetricsText({3, 2, 5'000'000'000, 7, true, "1.2.3", 4, 6, 600}));
  for (std::string line; std::getline(lines, line);) {
    if (line.rfind(metric + " ", 0) == 0) return std::stod(line.substr(metric.size()));
  }
  return 0;
}

TEST(Metrics, CountWhatHappens) {
  const auto counts = [](const std::string& metric, double by, const std::function<void()>& event) {
    const double before = ValueOf(metric);
    event();
    EXPECT_EQ(ValueOf(metric) - before, by) << metric;
  };
  const std::string requests = "farhorizon_http_requests_total";
  counts(requests + "{code=\"200\",method=\"GET\",route=\"/jobs/{id}\"}", 1,
         [] { CountRequest("GET", "/jobs/{id}", 200, std::chrono::milliseconds(3)); });
  counts(requests + "{code=\"404\",method=\"other\",route=\"none\"}", 1,
         [] { CountRequest("BREW", "", 404, std::chrono::milliseconds(1)); });
  counts("farhorizon_upload_bytes_total", 1000, [] { CountUploadedBytes(1000); });
  counts("farhorizon_job_queue_wait_seconds_count", 1,
         [] { CountJobStart(std::chrono::seconds(2)); });
  counts("farhorizon_job_queue_wait_seconds_sum", 0,  // the clock went back
         [] { CountJobStart(std::chrono::seconds(-2)); });
  counts("farhorizon_jobs_finished_total{code=\"too-small\",outcome=\"failed\"}", 1,
         [] { CountJobEnd("failed", "too-small"); });
  counts("farhorizon_job_stage_duration_seconds_sum{stage=\"horizon\"}", 0.25, [] {
    CountStages({{"horizon", 0.25}});
  });
  counts("farhorizon_worker_exits_total{reason=\"timeout\"}", 1, [] { CountWorkerEnd("timeout"); });
  counts("farhorizon_results_corrupt_total", 1, [] { CountCorruptResult(); });
}

TEST(Metrics, MeasureWhenAsked) {
  EXPECT_EQ(ValueOf("farhorizon_jobs{state=\"accepted\"}"), 3);
  EXPECT_EQ(ValueOf("farhorizon_jobs{state=\"running\"}"), 2);
  EXPECT_EQ(ValueOf("farhorizon_storage_free_bytes"), 5e9);
  EXPECT_EQ(ValueOf("farhorizon_log_lines_dropped_total"), 7);
  EXPECT_EQ(ValueOf("farhorizon_ready"), 1);
  EXPECT_EQ(ValueOf("farhorizon_waiting_requests"), 4);
  EXPECT_EQ(ValueOf("farhorizon_uploads"), 6);
  EXPECT_EQ(ValueOf("farhorizon_uploads_stored_bytes"), 600);
  EXPECT_EQ(ValueOf("farhorizon_build_info{version=\"1.2.3\"}"), 1);
  EXPECT_GT(ValueOf("process_resident_memory_bytes"), 1e6);
  EXPECT_GT(ValueOf("process_open_fds"), 2);
  EXPECT_GT(ValueOf("process_start_time_seconds"), 1.7e9);
}

TEST(Metrics, EachHasItsHelpAndIsNamedByItsUnit) {
  const std::string text = MetricsText({3, 2, 1, 0, true, "1.2.3"});
  std::istringstream lines(text);
  std::set<std::string> helped;
  for (std::string line; std::getline(lines, line);) {
    std::istringstream words(line);
    std::string mark;
    std::string what;
    std::string name;
    std::string kind;
    words >> mark >> what >> name >> kind;
    if (mark != "#") continue;
    if (what == "HELP") helped.insert(name);
    if (what == "TYPE") {
      EXPECT_EQ(helped.count(name), 1U) << name;
      EXPECT_EQ(kind == "counter", name.ends_with("_total")) << name;
    }
  }
  EXPECT_GE(helped.size(), 10U);  // those that have counted nothing are not told
}

}  // namespace
}  // namespace farhorizon
