#include "service/jobs/object_collector.h"

namespace farhorizon {

Status ObjectCollector::RemoveUnreferenced(const std::vector<std::string>& names) {
  const std::unique_lock lock(mutex_);
  for (const std::string& name : names) {
    Result<bool> referenced = jobs_.IsReferenced(name);
    if (!referenced) return std::move(referenced.error());
    if (*referenced) continue;
    Status removed = objects_.Remove(name);
    if (!removed) return removed;
  }
  return Ok{};
}

Status ObjectCollector::RemoveAllUnreferenced() {
  Result<std::vector<std::string>> all = objects_.List();
  if (!all) return std::move(all.error());
  return RemoveUnreferenced(*all);
}

}  // namespace farhorizon
