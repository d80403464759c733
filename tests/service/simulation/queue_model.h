#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <random>
#include <set>
#include <string>
#include <vector>

#include "service/jobs/job_store.h"

namespace farhorizon {

/// What is known of a job from the answers alone.
struct ModelJob {
  NewJob sent;
  Job last;                  ///< as it was seen last
  std::int64_t crashes = 0;  ///< of the service, while the job ran
  std::vector<std::string> artifacts;
};

/// The slow twin of a JobStore: plain maps, and the rules as job_store.h states them. It follows
/// every call, says what the answer has to be, and holds each job that it sees to what was seen
/// before. Faults are texts; none is left out for an earlier one.
class QueueModel {
 public:
  void Inserted(const NewJob& sent, const QueueBounds& bounds, const Result<Job>& answer);
  void Claimed(const std::optional<Job>& job, const MemoryRoom& room, std::int64_t now_ms);
  /// A call for run `run` of a job has answered `done`. Returns whether it had to.
  void Answered(const std::string& id, std::int64_t run, bool done);
  void Dismissed(const std::string& id, const Result<Job>& answer);
  void Recovered(PreviousEnd end, std::int64_t count);

  /// Holds the job, as Find gives it, to what is known; `to`: the state that a change has led to.
  void Saw(const Result<Job>& job, const std::string& id, std::optional<JobState> to = {});
  /// The job has gone by retention.
  void Gone(const std::string& id);

  [[nodiscard]] const std::map<std::string, ModelJob>& jobs() const { return jobs_; }
  ModelJob& At(const std::string& id) { return jobs_.at(id); }
  [[nodiscard]] std::int64_t Count(JobState state, const std::string& client = "") const;
  [[nodiscard]] const std::set<std::string>& garbage() const { return garbage_; }
  /// Whether the job runs, and this is its run.
  [[nodiscard]] bool IsCurrent(const std::string& id, std::int64_t run) const;

  [[nodiscard]] const std::vector<std::string>& faults() const { return faults_; }
  void Fault(const std::string& what) { faults_.push_back(what); }

 private:
  std::map<std::string, ModelJob> jobs_;
  std::map<std::string, std::string> keys_;  // to the id of their job
  std::set<std::string> garbage_;            // objects of removed jobs
  std::vector<std::string> faults_;
};

}  // namespace farhorizon
