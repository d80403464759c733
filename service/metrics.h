#pragma once

#include <chrono>
#include <cstdint>
#include <map>
#include <string>

namespace farhorizon {

/// What the process counts for Prometheus, in one registry, as there is one log.
/// service/OPERATING.md says what each metric means. All functions are safe in any thread.

/// One answered request. route: the pattern of its path, empty where there is none.
void CountRequest(const std::string& method, const std::string& route, int status,
                  std::chrono::duration<double> took);
/// Bytes of the bodies of submissions.
void CountUploadedBytes(std::int64_t bytes);
/// The start of a job's run, so long after it was accepted.
void CountJobStart(std::chrono::duration<double> waited);
/// The end of a job. outcome: the final state; code: of its failure, or empty.
void CountJobEnd(const std::string& outcome, const std::string& code);
/// Seconds by stage of a successful run.
void CountStages(const std::map<std::string, double>& seconds);
/// The end of a worker process. reason: "done", "stopped", or the kind of its error.
void CountWorkerEnd(const std::string& reason);
/// An artifact that is not the one that was stored.
void CountCorruptResult();
/// A fetch of a linked input. outcome: "done", or the kind of its error; bytes: that came.
void CountFetch(const std::string& outcome, std::int64_t bytes);

/// A call to a subscriber. event: as kCallbackEventNames has it; outcome: "delivered", "failed",
/// which is tried again, or "given-up".
void CountCallback(const std::string& event, const std::string& outcome);

/// What is measured when Prometheus asks.
struct Gauges {
  std::int64_t jobs_accepted = 0;
  std::int64_t jobs_running = 0;
  std::int64_t free_bytes = 0;
  std::int64_t log_lines_dropped = 0;
  bool ready = false;
  std::string version;                ///< of the program
  std::int64_t waiting_requests = 0;  ///< for changes of jobs
  std::int64_t uploads = 0;           ///< resumable ones that no job has yet
  std::int64_t upload_bytes = 0;      ///< of these, that are there
};

/// All metrics in the text format, version 0.0.4, with what is known of the process.
std::string MetricsText(const Gauges& gauges);

}  // namespace farhorizon
