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

// Families and metrics without labels, by name and help.
template <typename Builder>
auto& FamilyIn(prometheus::Registry& all, Builder builder, const char* name, const char* help) {
  return builder.Name(name).Help(help).Register(all);
}
prometheus::Counter& CounterIn(prometheus::Registry& all, const char* name, const char* help) {
  return FamilyIn(all, BuildCounter(), name, help).Add({});
}
prometheus::Gauge& GaugeIn(prometheus::Registry& all, const char* name, const char* help) {
  return FamilyIn(all, BuildGauge(), name, help).Add({});
}

struct Registry {
  prometheus::Registry all;
  prometheus::Family<prometheus::Counter>& requests = FamilyIn(
      all, BuildCounter(), "farhorizon_http_requests_total", "Requests that were answered");
  prometheus::Family<prometheus::Histogram>& request_seconds =
      FamilyIn(all, BuildHistogram(), "farhorizon_http_request_duration_seconds",
               "From a request's head to the end of its response");
  prometheus::Counter& uploaded =
      CounterIn(all, "farhorizon_upload_bytes_total", "Bytes of the bodies of submissions");
  prometheus::Gauge& uploads =
      GaugeIn(all, "farhorizon_uploads", "Resumable uploads that no job has yet");
  prometheus::Gauge& upload_bytes =
      GaugeIn(all, "farhorizon_uploads_stored_bytes", "Bytes of these that are there");
  prometheus::Histogram& waits =
      FamilyIn(all, BuildHistogram(), "farhorizon_job_queue_wait_seconds",
               "From a job's acceptance to the start of a run")
          .Add({}, WorkBuckets());
  prometheus::Family<prometheus::Counter>& ends =
      FamilyIn(all, BuildCounter(), "farhorizon_jobs_finished_total",
               "Jobs that ended, by outcome and code");
  prometheus::Family<prometheus::Histogram>& stages = FamilyIn(
      all, BuildHistogram(), "farhorizon_job_stage_duration_seconds", "Stages of successful runs");
  prometheus::Family<prometheus::Counter>& exits =
      FamilyIn(all, BuildCounter(), "farhorizon_worker_exits_total", "Worker processes that ended");
  prometheus::Counter& corrupt = CounterIn(all, "farhorizon_results_corrupt_total",
                                           "Artifacts that were not what had been stored");
  prometheus::Family<prometheus::Counter>& fetches =
      FamilyIn(all, BuildCounter(), "farhorizon_fetches_total", "Linked inputs, by outcome");
  prometheus::Counter& fetched =
      CounterIn(all, "farhorizon_fetched_bytes_total", "Bytes of linked inputs");
  prometheus::Family<prometheus::Counter>& callbacks =
      FamilyIn(all, BuildCounter(), "farhorizon_callbacks_total",
               "Calls to subscribers, by event and outcome");
  prometheus::Family<prometheus::Gauge>& jobs =
      FamilyIn(all, BuildGauge(), "farhorizon_jobs", "Jobs that have not ended, by state");
  prometheus::Gauge& waiting = GaugeIn(all, "farhorizon_waiting_requests",
                                       "Requests that wait for changes of jobs, event streams too");
  prometheus::Gauge& free_bytes =
      GaugeIn(all, "farhorizon_storage_free_bytes", "Room on the disk of the data folder");
  prometheus::Counter& dropped =
      CounterIn(all, "farhorizon_log_lines_dropped_total", "Lines of the log that nobody read");
  prometheus::Gauge& ready = GaugeIn(all, "farhorizon_ready", "1 if /readyz answers 200");
  prometheus::Counter& cpu = CounterIn(all, "process_cpu_seconds_total",
                                       "Processor time of the service without its workers");
  prometheus::Gauge& resident = GaugeIn(all, "process_resident_memory_bytes",
                                        "Resident memory of the service without its workers");
  prometheus::Gauge& files = GaugeIn(all, "process_open_fds", "Open descriptors");
  prometheus::Gauge& most_files = GaugeIn(all, "process_max_fds", "Most open descriptors");
  prometheus::Gauge& start =
      GaugeIn(all, "process_start_time_seconds", "Start of the process, seconds since 1970");
  prometheus::Family<prometheus::Gauge>& build =
      FamilyIn(all, BuildGauge(), "farhorizon_build_info", "Always 1; the version is in the label");
};

Registry& Registered() {
  static Registry registry;
  return registry;
}

// The values of a label must be few: a client makes up methods as it likes.
std::string MethodLabel(const std::string& method) {
  constexpr std::array<std::string_view, 7> kKnown = {"GET", "HEAD",  "POST",   "DELETE",
                                                      "PUT", "PATCH", "OPTIONS"};
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

void CountFetch(const std::string& outcome, std::int64_t bytes) {
  Registered().fetches.Add({{"outcome", outcome}}).Increment();
  Registered().fetched.Increment(static_cast<double>(bytes));
}

void CountCallback(const std::string& event, const std::string& outcome) {
  Registered().callbacks.Add({{"event", event}, {"outcome", outcome}}).Increment();
}

std::string MetricsText(const Gauges& gauges) {
  Registry& registry = Registered();
  registry.jobs.Add({{"state", "accepted"}}).Set(static_cast<double>(gauges.jobs_accepted));
  registry.jobs.Add({{"state", "running"}}).Set(static_cast<double>(gauges.jobs_running));
  registry.uploads.Set(static_cast<double>(gauges.uploads));
  registry.upload_bytes.Set(static_cast<double>(gauges.upload_bytes));
  registry.waiting.Set(static_cast<double>(gauges.waiting_requests));
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
