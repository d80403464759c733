#pragma once

#include <cstdint>
#include <deque>
#include <filesystem>
#include <map>
#include <memory>
#include <random>
#include <set>
#include <string>
#include <vector>

#include "service/jobs/job_store.h"
#include "service/jobs/object_collector.h"
#include "tests/service/simulation/memory_objects.h"
#include "tests/support/temp_dir.h"

namespace farhorizon {

/// Clients, workers, clock and restarts drawn from a seed, against the real job store and the real
/// collector of objects. After every step, all jobs are compared with what the step may do.
class Simulation {
 public:
  /// below: where the store's folder is made.
  Simulation(std::uint32_t seed, const std::filesystem::path& below);

  /// Takes `steps` random steps, then lets every job end. Returns what was found broken, with the
  /// last steps; empty if nothing was.
  std::string Run(int steps);

 private:
  /// The memory of all jobs together.
  static constexpr std::int64_t kMostMemory = 1000;

  // What is known of a job beside its row.
  struct Known {
    Job job;
    std::vector<std::string> artifacts;
    std::int64_t process_crashes = 0;
    std::int64_t not_before_ms = 0;
  };
  // A run that some worker has, its lease lost or not.
  struct Worker {
    std::string id;
    std::int64_t run = 0;
  };

  void Open();
  void Step();
  void Submit();
  void Claim();
  void Work();
  void Report(const Worker& worker, int deed);
  Result<bool> Publish(const Worker& worker);
  Result<bool> CrashOnce(const Worker& worker);
  void Dismiss();
  void Expire();
  void FailOverdue();
  void Collect();
  void Restart();
  void Drain();

  void CheckClaim(const Job& claimed, std::int64_t free_bytes);
  void CheckNoClaim(std::int64_t free_bytes);
  // Compares all rows with those known; the jobs `may_change` may have made one step.
  void CheckAll(const std::set<std::string>& may_change, bool may_remove = false);
  void CheckChange(const Known& known, const Job& now, bool may_change);
  // Holds a job against the objects, and its artifacts against those published.
  void CheckObjects(const Known& known);
  void CheckArtifacts(const Known& known);
  void CheckNoOrphans();

  [[nodiscard]] std::int64_t Waiting(const std::string* client) const;
  [[nodiscard]] std::int64_t Running(const std::string* client) const;
  [[nodiscard]] bool MayStart(const Known& known, std::int64_t free_bytes) const;
  // The time of a call that writes.
  std::int64_t Now();
  std::uint32_t Draw(std::uint32_t below) { return static_cast<std::uint32_t>(random_()) % below; }
  std::string DrawObject() { return std::string(64, "0123456789abcdef"[Draw(16)]); }
  void Note(const std::string& step);
  void Demand(bool holds, const std::string& what);

  std::mt19937 random_;
  bool unstable_;  // the service crashes again and again
  TempDir folder_;
  MemoryObjects objects_;
  std::unique_ptr<JobStore> jobs_;
  std::int64_t now_ms_ = 1'700'000'000'000;
  std::int64_t latest_ms_ = 0;  // the store's: it does not go back
  std::int64_t turns_ = 0;      // starts since the store was opened
  std::map<std::string, Known> known_;
  std::map<std::string, std::string> keys_;
  std::vector<Worker> workers_;
  std::deque<std::string> notes_;
  std::string broken_;
};

}  // namespace farhorizon
