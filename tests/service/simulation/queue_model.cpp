#include "tests/service/simulation/queue_model.h"

#include <algorithm>

namespace farhorizon {

namespace {

bool Alike(const NewJob& a, const NewJob& b) {
  return a.input_sha256 == b.input_sha256 && a.filename == b.filename &&
         a.parameters == b.parameters && a.terms.priority == b.terms.priority &&
         a.terms.deadline_seconds == b.terms.deadline_seconds;
}

}  // namespace

std::int64_t QueueModel::Count(JobState state, const std::string& client) const {
  return std::count_if(jobs_.begin(), jobs_.end(), [&](const auto& entry) {
    return entry.second.last.state == state &&
           (client.empty() || entry.second.sent.client == client);
  });
}

bool QueueModel::IsCurrent(const std::string& id, std::int64_t run) const {
  const auto found = jobs_.find(id);
  return found != jobs_.end() && found->second.last.state == JobState::kRunning &&
         found->second.last.run == run;
}

void QueueModel::Inserted(const NewJob& sent, const QueueBounds& bounds,
                          const Result<Job>& answer) {
  const auto key = sent.idempotency_key ? keys_.find(*sent.idempotency_key) : keys_.end();
  if (key != keys_.end()) {
    const bool alike = Alike(jobs_.at(key->second).sent, sent);
    if (alike && (!answer || answer->id != key->second)) Fault("I6: a key has made a second job");
    if (!alike && answer) Fault("a key that was used for another job was taken");
    return;
  }
  const bool own_full = Count(JobState::kAccepted, sent.client) >= bounds.of_client;
  const bool full = Count(JobState::kAccepted) >= bounds.all;
  if (own_full || full) {
    if (answer) Fault("the queue has taken more than its bound");
    return;
  }
  if (!answer) return Fault("the queue has room and refuses: " + answer.error().message);
  if (!jobs_.empty() && answer->id <= jobs_.rbegin()->first) {
    return Fault("ids do not have the order of the jobs");
  }
  if (answer->state != JobState::kAccepted) Fault("a new job is not accepted");
  jobs_[answer->id] = {sent, *answer, 0, {}};
  if (sent.idempotency_key) keys_[*sent.idempotency_key] = answer->id;
}

void QueueModel::Claimed(const std::optional<Job>& job, const MemoryRoom& room,
                         std::int64_t now_ms) {
  if (!job) {
    // Nothing runs, and one that was not put off waits: then there has to be one to start.
    const bool waits = std::any_of(jobs_.begin(), jobs_.end(), [&](const auto& entry) {
      const Job& last = entry.second.last;
      return last.state == JobState::kAccepted && last.retries == 0 &&
             last.deadline_ms.value_or(now_ms + 1) > now_ms;
    });
    if (waits && Count(JobState::kRunning) == 0) Fault("a job waits, and none is started");
    return;
  }
  const auto found = jobs_.find(job->id);
  if (found == jobs_.end()) return Fault("a job that nobody has sent is started");
  ModelJob& known = found->second;
  if (known.last.state != JobState::kAccepted) Fault("a job that does not wait is started");
  if (job->run != known.last.run + 1 || job->attempt != known.last.attempt + 1) {
    Fault("a start does not count as one");
  }
  const std::int64_t needs = known.sent.cost.memory_bytes > 0
                                 ? std::min(known.sent.cost.memory_bytes, room.most_bytes)
                                 : room.most_bytes;
  if (needs > room.free_bytes) Fault("a job is started that there is no room for");
  if (known.crashes > 0 && Count(JobState::kRunning) > 0) {
    Fault("a job that may be at fault for a crash runs beside others");
  }
  Saw(*job, job->id, JobState::kRunning);
}

void QueueModel::Answered(const std::string& id, std::int64_t run, bool done) {
  if (done != IsCurrent(id, run)) {
    Fault(done ? "a run that is not the job's own has changed it"
               : "the job's own run could not change it");
  }
}

void QueueModel::Dismissed(const std::string& id, const Result<Job>& answer) {
  const auto found = jobs_.find(id);
  if (found == jobs_.end()) {
    if (answer) Fault("a job that is gone was dismissed");
    return;
  }
  if (!answer) return Fault("a job could not be dismissed: " + answer.error().message);
  if (IsTerminal(found->second.last.state)) return Gone(id);
  Saw(*answer, id, JobState::kDismissed);
}

void QueueModel::Gone(const std::string& id) {
  const auto found = jobs_.find(id);
  if (!IsTerminal(found->second.last.state)) Fault("I1: a job that had not ended is gone");
  garbage_.insert(found->second.sent.input_sha256);
  garbage_.insert(found->second.artifacts.begin(), found->second.artifacts.end());
  std::erase_if(keys_, [&](const auto& key) { return key.second == id; });
  jobs_.erase(found);
}

void QueueModel::Recovered(PreviousEnd end, std::int64_t count) {
  constexpr std::int64_t kMostCrashes = 3;
  std::int64_t again = 0;
  for (auto& [id, job] : jobs_) {
    if (job.last.state != JobState::kRunning) continue;
    if (end == PreviousEnd::kCrashed) ++job.crashes;
    again += job.crashes < kMostCrashes ? 1 : 0;
  }
  if (again != count) Fault("a start has taken up the wrong number of jobs");
}

void QueueModel::Saw(const Result<Job>& job, const std::string& id, std::optional<JobState> to) {
  const auto found = jobs_.find(id);
  if (found == jobs_.end()) {
    if (job) Fault("a removed job is there again");
    return;
  }
  if (!job) return Fault("I8: an acknowledged job is gone");
  const Job& last = found->second.last;
  const std::string which = "job " + id + ": ";
  if (job->state != to.value_or(last.state)) {
    Fault(which + JobStateName(job->state) + " in place of " +
          JobStateName(to.value_or(last.state)));
  }
  if (job->state != last.state && !MayFollow(last.state, job->state)) {
    Fault(which + "I3: " + JobStateName(job->state) + " after " + JobStateName(last.state));
  }
  if (IsTerminal(last.state) && job->finished_ms != last.finished_ms) Fault(which + "I2: two ends");
  if (job->progress < last.progress || job->updated_ms < last.updated_ms || job->run < last.run) {
    Fault(which + "I3: progress, time or run went back");
  }
  if (job->attempt < 0 || job->attempt > job->run || job->crash_count < last.crash_count) {
    Fault(which + "attempts are miscounted");
  }
  if (job->created_ms != last.created_ms || job->input_sha256 != found->second.sent.input_sha256) {
    Fault(which + "it is another job");
  }
  if (IsTerminal(job->state) != job->finished_ms.has_value()) Fault(which + "end without a time");
  found->second.last = *job;
}

}  // namespace farhorizon
