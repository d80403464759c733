#include "service/metrics.h"

#include <algorithm>
#include <array>
#include <prometheus/counter.h>
#include <prometheus/family.h>
#include <prometheus/gauge.h>
#include <prometheus/histogram.h>
#include <prometheus/registry.h>
#include <prometheus/text_serializer.h>
#include <string_view>

#include "service/process_info.h"

namespace farhorizon {

namespace {

using prometheus::BuildCounter;
using prometheus::BuildGauge;
using prometheus::BuildHistogram;
using Buckets = prometheus::Histogram::BucketBoundaries;

// From a status to the upload of a large DEM.
const Buckets& RequestBuckets() {
  static const Buckets buckets = {0.001, 0.005, 0.02, 0.1, 0.5, 2, 10, 60};
  return buckets;
}
// From a small tile to the largest DEM.
const Buckets& WorkBuckets() {
  static const Buckets buckets = {0.01, 0.05, 0.25, 1, 5, 25, 120, 600, 3600};
  return buckets;
}

struct Registry {
  prometheus::Registry all;
  prometheus::Family<prometheus::Counter>& requests = BuildCounter()
                                                          .Name("farhorizon_http_requests_total")
                                                          .Help("Requests that were answered")
                                                          .Register(all);
  prometheus::Family<prometheus::Histogram>& request_seconds =
      BuildHistogram()
          .Name("farhorizon_http_request_duration_seconds")
          .Help("From a request's head to the end of its response")
          .Register(all);
  prometheus::Counter& uploaded = BuildCounter()
                                      .Name("farhorizon_upload_bytes_total")
                                      .Help("Bytes of the bodies of submissions")
                                      .Register(all)
                                      .Add({});
  prometheus::Histogram& waits = BuildHistogram()
                                     .Name("farhorizon_job_queue_wait_seconds")
                                     .Help("From a job's acceptance to the start of a run")
                                     .Register(all)
                                     .Add({}, WorkBuckets());
  prometheus::Family<prometheus::Counter>& ends = BuildCounter()
                                                      .Name("farhorizon_jobs_finished_total")
                                                      .Help("Jobs that ended, by outcome and code")
                                                      .Register(all);
  prometheus::Family<prometheus::Histogram>& stages =
      BuildHistogram()
          .Name("farhorizon_job_stage_duration_seconds")
          .Help("Stages of successful runs")
          .Register(all);
  prometheus::Family<prometheus::Counter>& exits = BuildCounter()
                                                       .Name("farhorizon_worker_exits_total")
                                                       .Help("Worker processes that ended")
                                                       .Register(all);
  prometheus::Counter& corrupt = BuildCounter()
                                     .Name("farhorizon_results_corrupt_total")
                                     .Help("Artifacts that were not what had been stored")
                                     .Register(all)
                                     .Add({});
  prometheus::Family<prometheus::Gauge>& jobs =
      BuildGauge().Name("farhorizon_jobs").Help("Jobs that have not ended, by state").Register(all);
  prometheus::Gauge& free_bytes = BuildGauge()
                                      .Name("farhorizon_storage_free_bytes")
                                      .Help("Room on the disk of the data folder")
                                      .Register(all)
                                      .Add({});
  prometheus::Counter& dropped = BuildCounter()
                                     .Name("farhorizon_log_lines_dropped_total")
                                     .Help("Lines of the log that nobody read")
                                     .Register(all)
                                     .Add({});
  prometheus::Gauge& ready =
      BuildGauge().Name("farhorizon_ready").Help("1 if /readyz answers 200").Register(all).Add({});
  prometheus::Counter& cpu = BuildCounter()
                                 .Name("process_cpu_seconds_total")
                                 .Help("Processor time of the service without its workers")
                                 .Register(all)
                                 .Add({});
  prometheus::Gauge& resident = BuildGauge()
                                    .Name("process_resident_memory_bytes")
                                    .Help("Resident memory of the service without its workers")
                                    .Register(all)
                                    .Add({});
  prometheus::Gauge& files =
      BuildGauge().Name("process_open_fds").Help("Open descriptors").Register(all).Add({});
  prometheus::Gauge& most_files =
      BuildGauge().Name("process_max_fds").Help("Most open descriptors").Register(all).Add({});
  prometheus::Gauge& start = BuildGauge()
                                 .Name("process_start_time_seconds")
                                 .Help("Start of the process, seconds since 1970")
                                 .Register(all)
                                 .Add({});
  prometheus::Family<prometheus::Gauge>& build = BuildGauge()
                                                     .Name("farhorizon_build_info")
                                                     .Help("Always 1; the version is in the label")
                                                     .Register(all);
};

Registry& Registered() {
  static Registry registry;
  return registry;
}

// The values of a label must be few: a client makes up methods as it likes.
std::string MethodLabel(const std::string& method) {
  constexpr std::array<std::string_view, 6> kKnown = {"GET",    "HEAD", "POST",
                                                      "DELETE", "PUT",  "OPTIONS"};
  return std::find(kKnown.begin(), kKnown.end(), method) != kKnown.end() ? method : "other";
}

void RaiseTo(prometheus::Counter& counter, double value) {
  counter.Increment(std::max(0.0, value - counter.Value()));
}

}  // namespace

void CountRequest(const std::string& method, const std::string& route, int status,
                  std::chrono::duration<double> took) {
  const std::string pattern = route.empty() ? "none" : route;
  Registered()
      .requests
      .Add({{"method", MethodLabel(method)}, {"route", pattern}, {"code", std::to_string(status)}})
      .Increment();
  Registered().request_seconds.Add({{"route", pattern}}, RequestBuckets()).Observe(took.count());
}

void CountUploadedBytes(std::int64_t bytes) {
  Registered().uploaded.Increment(static_cast<double>(bytes));
}

void CountJobStart(std::chrono::duration<double> waited) {
  Registered().waits.Observe(std::max(0.0, waited.count()));
}

void CountJobEnd(const std::string& outcome, const std::string& code) {
  Registered().ends.Add({{"outcome", outcome}, {"code", code}}).Increment();
}

void CountStages(const std::map<std::string, double>& seconds) {
  for (const auto& [stage, time] : seconds) {
    Registered().stages.Add({{"stage", stage}}, WorkBuckets()).Observe(time);
  }
}

void CountWorkerEnd(const std::string& reason) {
  Registered().exits.Add({{"reason", reason}}).Increment();
}

void CountCorruptResult() { Registered().corrupt.Increment(); }

std::string MetricsText(const Gauges& gauges) {
  Registry& registry = Registered();
  registry.jobs.Add({{"state", "accepted"}}).Set(static_cast<double>(gauges.jobs_accepted));
  registry.jobs.Add({{"state", "running"}}).Set(static_cast<double>(gauges.jobs_running));
  registry.free_bytes.Set(static_cast<double>(gauges.free_bytes));
  RaiseTo(registry.dropped, static_cast<double>(gauges.log_lines_dropped));
  registry.ready.Set(gauges.ready ? 1 : 0);
  registry.build.Add({{"version", gauges.version}}).Set(1);
  const ProcessInfo process = ReadProcessInfo();
  RaiseTo(registry.cpu, process.cpu_seconds);
  registry.resident.Set(static_cast<double>(process.resident_bytes));
  registry.files.Set(static_cast<double>(process.open_files));
  registry.most_files.Set(static_cast<double>(process.most_files));
  registry.start.Set(process.start_seconds);
  return prometheus::TextSerializer().Serialize(registry.all.Collect());
}

}  // namespace farhorizon
