#include "service/jobs/job_store.h"

#include <mutex>
#include <utility>

namespace farhorizon {

namespace {

template <typename Lock>
class LocalObjectLock : public ObjectLock {
 public:
  explicit LocalObjectLock(Lock lock) : lock_(std::move(lock)) {}

 private:
  Lock lock_;
};

template <typename Lock>
std::unique_ptr<ObjectLock> Own(Lock lock) {
  return std::make_unique<LocalObjectLock<Lock>>(std::move(lock));
}

}  // namespace

Result<std::vector<std::string>> JobStore::Hold(const std::vector<HeldRun>& runs) {
  std::vector<std::string> over;
  for (const auto& [id, run] : runs) {
    const Result<Job> job = Find(id);
    if (!job && job.error().code != ErrorCode::kNotFound) return job.error();
    if (!job || job->state != JobState::kRunning || job->run != run) over.push_back(id);
  }
  return over;
}

Result<std::unique_ptr<ObjectLock>> JobStore::PinObjects() { return Own(std::shared_lock(pins_)); }

Result<std::unique_ptr<ObjectLock>> JobStore::HaltPins(bool wait) {
  if (wait) return Own(std::unique_lock(pins_));
  std::unique_lock lock(pins_, std::try_to_lock);
  if (!lock) return std::unique_ptr<ObjectLock>();
  return Own(std::move(lock));
}

}  // namespace farhorizon
