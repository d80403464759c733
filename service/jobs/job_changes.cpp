#include "service/jobs/job_changes.h"

namespace farhorizon {

std::unique_ptr<JobChanges::Watch> JobChanges::Add(const std::string& job,
                                                   const std::string& client) {
  const std::lock_guard lock(mutex_);
  if (static_cast<std::int64_t>(watches_.size()) >= most_) return nullptr;
  const auto own = by_client_.find(client);
  if (own != by_client_.end() && own->second >= most_ - most_ / 8) return nullptr;
  std::unique_ptr<Watch> watch(new Watch(shared_from_this(), job, client));
  watches_.emplace(job, watch.get());
  ++by_client_[client];
  return watch;
}

JobChanges::Watch::~Watch() {
  const std::lock_guard lock(changes_->mutex_);
  auto [first, last] = changes_->watches_.equal_range(job_);
  while (first != last && first->second != this) ++first;
  changes_->watches_.erase(first);
  const auto own = changes_->by_client_.find(client_);
  if (--own->second == 0) changes_->by_client_.erase(own);
}

void JobChanges::Watch::Listen(std::function<void()> wake) {
  const std::lock_guard lock(changes_->mutex_);
  wake_ = std::move(wake);
}

void JobChanges::Tell(const std::string& job) {
  const std::lock_guard lock(mutex_);
  auto [first, last] =
      job.empty() ? std::pair(watches_.begin(), watches_.end()) : watches_.equal_range(job);
  for (; first != last; ++first) {
    if (first->second->wake_) first->second->wake_();
  }
}

std::int64_t JobChanges::Count() const {
  const std::lock_guard lock(mutex_);
  return static_cast<std::int64_t>(watches_.size());
}

}  // namespace farhorizon
