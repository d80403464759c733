#include "service/jobs/object_keeper.h"

namespace farhorizon {

Status ObjectKeeper::RemoveUnnamed(const std::vector<std::string>& names) {
  const std::unique_lock lock(mutex_);
  for (const std::string& name : names) {
    Result<bool> named = jobs_.IsReferenced(name);
    if (!named) return std::move(named.error());
    if (*named) continue;
    Status removed = objects_.Remove(name);
    if (!removed) return removed;
  }
  return Done{};
}

Status ObjectKeeper::RemoveAllUnnamed() {
  Result<std::vector<std::string>> all = objects_.List();
  if (!all) return std::move(all.error());
  return RemoveUnnamed(*all);
}

}  // namespace farhorizon
