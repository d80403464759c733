// What is asked of every job after every step.
#include <algorithm>

#include "tests/service/simulation/simulation.h"

namespace farhorizon {

namespace {

// All of a job that a client may see.
std::string Describe(const Job& job) {
  std::string text = std::string(JobStateName(job.state)) + " run " + std::to_string(job.run) +
                     " attempt " + std::to_string(job.attempt) + " crashes " +
                     std::to_string(job.crash_count) + " retries " + std::to_string(job.retries) +
                     " progress " + std::to_string(job.progress) + " updated " +
                     std::to_string(job.updated_ms) + " finished " +
                     std::to_string(job.finished_ms.value_or(0)) + " '" + job.message + "'";
  if (job.failure) text += " " + std::string(job.failure->kind);
  return text;
}

}  // namespace

bool Simulation::MayStart(const Known& known, std::int64_t free_bytes) const {
  const Job& job = known.job;
  const std::int64_t needs = job.cost.memory_bytes > 0 ? job.cost.memory_bytes : kMostMemory;
  return job.state == JobState::kAccepted && known.not_before_ms <= latest_ms_ &&
         job.deadline_ms.value_or(latest_ms_ + 1) > latest_ms_ &&
         std::min(needs, kMostMemory) <= free_bytes &&
         (known.process_crashes == 0 || Running(nullptr) == 0);
}

void Simulation::CheckNoClaim(std::int64_t free_bytes) {
  if (Running(nullptr) > 0) return;  // it may wait for these
  for (const auto& [id, known] : known_) {
    Demand(!MayStart(known, free_bytes), "nothing runs, and " + id + " may start, but does not");
  }
}

void Simulation::CheckClaim(const Job& claimed, std::int64_t free_bytes) {
  if (!known_.contains(claimed.id)) return Demand(false, "a claimed job was submitted");
  const Known& chosen = known_[claimed.id];
  Demand(MayStart(chosen, free_bytes), "a claimed job may start");
  Demand(claimed.run == chosen.job.run + 1, "a start has the next run");
  const bool all_alike = turns_ % 4 == 3;
  for (const auto& [id, known] : known_) {
    if (known.job.state == JobState::kRunning) {
      Demand(known.process_crashes == 0, "what ran in a crash runs alone");
    }
    if (!MayStart(known, free_bytes)) continue;
    if (!all_alike) Demand(known.job.priority <= chosen.job.priority, "the highest priority first");
    if (!all_alike && known.job.priority != chosen.job.priority) continue;
    Demand(Running(&known.job.client) >= Running(&chosen.job.client), "the fair share holds");
    if (known.job.client == chosen.job.client) Demand(id >= claimed.id, "the oldest first");
  }
}

void Simulation::CheckAll(const std::set<std::string>& may_change, bool may_remove) {
  if (!broken_.empty()) return;
  const Result<JobPage> page = jobs_->List({{}, {}, 10'000});
  if (!page) return Demand(false, "the list is answered");
  std::map<std::string, Job> rows;
  for (const Job& job : page->jobs) rows[job.id] = job;
  for (const auto& [id, job] : rows) Demand(known_.contains(id), "nobody submitted " + id);
  for (auto at = known_.begin(); at != known_.end();) {
    const auto row = rows.find(at->first);
    if (row == rows.end()) {
      Demand(may_remove && IsTerminal(at->second.job.state), "I1: lost " + at->first);
      at = known_.erase(at);
      continue;
    }
    CheckChange(at->second, row->second, may_change.contains(at->first));
    at->second.job = row->second;
    CheckObjects(at->second);
    if (may_change.contains(at->first) || Draw(16) == 0) CheckArtifacts(at->second);
    ++at;
  }
  for (const std::string& id : may_change) {
    const Result<Job> found = jobs_->Find(id);
    if (rows.contains(id)) {
      Demand(found && Describe(*found) == Describe(rows[id]), "list and status agree");
    }
  }
}

void Simulation::CheckChange(const Known& known, const Job& now, bool may_change) {
  const Job& before = known.job;
  const std::string change = now.id + ": " + Describe(before) + " -> " + Describe(now);
  if (!may_change || IsTerminal(before.state)) {
    Demand(Describe(before) == Describe(now), "changed without a cause: " + change);
  }
  Demand(now.state == before.state || MayFollow(before.state, now.state), "I3, I5: " + change);
  Demand(now.progress >= before.progress && now.updated_ms >= before.updated_ms &&
             now.run >= before.run && now.created_ms == before.created_ms,
         "I3: " + change);
  Demand(now.created_ms <= now.started_ms.value_or(now.created_ms) &&
             now.started_ms.value_or(now.created_ms) <= now.finished_ms.value_or(now.updated_ms),
         "times in order: " + change);
  Demand(now.finished_ms.has_value() == IsTerminal(now.state), "an end has a time: " + change);
  Demand(now.failure.has_value() == (now.state == JobState::kFailed), "a cause: " + change);
  Demand(now.attempt >= 0 && now.attempt <= now.run && now.crash_count <= 1 &&
             now.attempt + now.retries <= now.run,
         "counts within their bounds: " + change);
}

void Simulation::CheckObjects(const Known& known) {
  const Job& job = known.job;
  Demand(objects_.Has(job.input_sha256), "I8: the input of " + job.id + " is there");
  if (job.state != JobState::kSuccessful) return;
  for (const std::string& name : known.artifacts) {
    Demand(objects_.Has(name), "I4: what a successful job has made is there: " + job.id);
  }
}

void Simulation::CheckArtifacts(const Known& known) {
  const auto listed = jobs_->Artifacts(known.job.id);
  if (!listed) return Demand(false, "artifacts are answered");
  const bool successful = known.job.state == JobState::kSuccessful;
  const std::vector<std::string> expected =
      successful ? known.artifacts : decltype(known.artifacts){};
  Demand(ObjectsOf(*listed) == expected, "I2: one result of " + known.job.id);
}

void Simulation::CheckNoOrphans() {
  std::set<std::string> named;
  for (const auto& [id, known] : known_) {
    named.insert(known.job.input_sha256);
    if (known.job.state == JobState::kSuccessful) {
      named.insert(known.artifacts.begin(), known.artifacts.end());
    }
  }
  const auto objects = *objects_.List(ObjectList::kAll);
  Demand(std::set<std::string>(objects.begin(), objects.end()) == named,
         "I7: the objects are those of the rows");
}

std::int64_t Simulation::Waiting(const std::string* client) const {
  return std::count_if(known_.begin(), known_.end(), [&](const auto& entry) {
    const Job& job = entry.second.job;
    return job.state == JobState::kAccepted && (client == nullptr || job.client == *client);
  });
}

std::int64_t Simulation::Running(const std::string* client) const {
  return std::count_if(known_.begin(), known_.end(), [&](const auto& entry) {
    const Job& job = entry.second.job;
    return job.state == JobState::kRunning && (client == nullptr || job.client == *client);
  });
}

}  // namespace farhorizon
