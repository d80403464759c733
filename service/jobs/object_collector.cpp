#include "service/jobs/object_collector.h"

namespace farhorizon {

Status ObjectCollector::RemoveUnreferenced(const std::vector<std::string>& names) {
  return RemoveUnder(jobs_.HaltPins(true), names);
}

Status ObjectCollector::RemoveUnlessPinned(const std::vector<std::string>& names) {
  return RemoveUnder(jobs_.HaltPins(false), names);
}

Status ObjectCollector::RemoveUnder(const Result<std::unique_ptr<ObjectLock>>& halt,
                                    const std::vector<std::string>& names) {
  if (!halt) return halt.error();
  return *halt ? RemoveEach(names) : Ok{};
}

Status ObjectCollector::RemoveEach(const std::vector<std::string>& names) {
  std::vector<std::string> unreferenced;
  for (const std::string& name : names) {
    Result<bool> referenced = jobs_.IsReferenced(name);
    if (!referenced) return std::move(referenced.error());
    if (!*referenced) unreferenced.push_back(name);
  }
  return objects_.RemoveAll(unreferenced);
}

Status ObjectCollector::RemoveUnacknowledged() {
  Result<std::vector<std::string>> any = objects_.List(ObjectList::kIncoming);
  if (!any) return std::move(any.error());
  if (any->empty()) return Ok{};
  const Result<std::unique_ptr<ObjectLock>> halt = jobs_.HaltPins(true);
  if (!halt) return halt.error();
  if (!*halt) return Ok{};
  // Nobody is between an object and its row.
  Result<std::vector<std::string>> named = Select(ObjectList::kIncoming, true);
  if (!named) return std::move(named.error());
  Result<std::vector<std::string>> unnamed = Select(ObjectList::kIncoming, false);
  if (!unnamed) return std::move(unnamed.error());
  objects_.Keep(*named);
  return objects_.RemoveAll(*unnamed);
}

Status ObjectCollector::RemoveGarbage() {
  Result<std::vector<std::string>> garbage = jobs_.Garbage();
  if (!garbage) return std::move(garbage.error());
  std::vector<std::string> names;
  for (std::string& name : *garbage) {
    if (IsSha256(name)) names.push_back(std::move(name));
  }
  if (names.empty()) return Ok{};
  const Result<std::unique_ptr<ObjectLock>> halt = jobs_.HaltPins(true);
  if (!halt) return halt.error();
  if (!*halt) return Ok{};
  Status removed = RemoveEach(names);
  if (!removed) return removed;
  return jobs_.ForgetGarbage(names);
}

Result<std::vector<std::string>> ObjectCollector::Select(ObjectList which, bool referenced) {
  Result<std::vector<std::string>> names = objects_.List(which);
  if (!names) return names;
  std::vector<std::string> selected;
  for (std::string& name : *names) {
    Result<bool> has_row = jobs_.IsReferenced(name);
    if (!has_row) return std::move(has_row.error());
    if (*has_row == referenced) selected.push_back(std::move(name));
  }
  return selected;
}

Result<SortedObjects> ObjectCollector::SortOut() {
  Status done = RemoveGarbage();
  if (!done) return std::move(done.error());
  done = RemoveUnacknowledged();
  if (!done) return std::move(done.error());
  Result<std::vector<std::string>> strays = Select(ObjectList::kAll, false);
  if (!strays) return std::move(strays.error());
  Result<std::vector<std::string>> known = Select(ObjectList::kStray, true);
  if (!known) return std::move(known.error());
  for (const std::string& name : *strays) {
    done = objects_.SetAside(name);
    if (!done) return std::move(done.error());
  }
  SortedObjects sorted{static_cast<std::int64_t>(strays->size()), 0};
  for (const std::string& name : *known) {
    if (objects_.Open(name)) continue;  // the store has another copy
    done = objects_.TakeBack(name);
    if (!done) return std::move(done.error());
    ++sorted.taken_back;
  }
  return sorted;
}

}  // namespace farhorizon
