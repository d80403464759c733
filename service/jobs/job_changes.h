#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <string>
#include <utility>

namespace farhorizon {

/// Wakes those who wait for a change of a job: event streams, and requests that are answered late.
///
/// A wake says that the job may have changed: whoever gets it looks into the store. So it does not
/// matter whether a change was made by this process or, in a store that several share, by another;
/// nor whether two changes make one wake.
/// Threads: safe.
class JobChanges : public std::enable_shared_from_this<JobChanges> {
 public:
  /// Somebody who waits for changes of one job; counted as long as it lives.
  class Watch {
   public:
    ~Watch();
    Watch(const Watch&) = delete;
    Watch& operator=(const Watch&) = delete;

    /// Calls `wake` after each change from now on, on the thread that makes it, until this object
    /// is gone. `wake` must not wait, and must not call this object's JobChanges.
    void Listen(std::function<void()> wake);

   private:
    friend class JobChanges;
    Watch(std::shared_ptr<JobChanges> changes, std::string job, std::string client)
        : changes_(std::move(changes)), job_(std::move(job)), client_(std::move(client)) {}

    const std::shared_ptr<JobChanges> changes_;
    const std::string job_;
    const std::string client_;
    std::function<void()> wake_;
  };

  /// most: watches at once; of one client, all but an eighth of them.
  explicit JobChanges(std::int64_t most) : most_(most) {}
  JobChanges(const JobChanges&) = delete;
  JobChanges& operator=(const JobChanges&) = delete;

  /// nullptr where there are as many as may be. Requires: a shared_ptr holds this.
  [[nodiscard]] std::unique_ptr<Watch> Add(const std::string& job, const std::string& client);

  /// The job may have changed; an empty text: any may.
  void Tell(const std::string& job);

  [[nodiscard]] std::int64_t Count() const;

 private:
  const std::int64_t most_;
  mutable std::mutex mutex_;
  std::multimap<std::string, Watch*> watches_;     // by job
  std::map<std::string, std::int64_t> by_client_;  // how many
};

}  // namespace farhorizon
