#include "service/jobs/shared_identity.h"

#include <memory>
#include <optional>
#include <string>

#include "service/jobs/store_identity.h"
#include "service/log.h"

namespace farhorizon {

namespace {

// The identity that the objects have; nullopt where they have none.
Result<std::optional<StoreIdentity>> IdentityOf(ObjectStore& objects) {
  Result<std::string> label = objects.Label();
  if (label) return ParseIdentity(*label);
  if (label.error().code != ErrorCode::kNotFound) return std::move(label.error());
  return std::optional<StoreIdentity>();
}

Status CheckFit(const std::optional<StoreIdentity>& theirs, const StoreIdentity& own) {
  if (!theirs) {
    return UnusableStore(
        "the uploads and results of its jobs are gone: the database was used with others before",
        "mount or name the right ones (store.objects); or, where they are lost for good, give them "
        "a file \"identity\" with the line \"" +
            own.id + " " + std::to_string(own.generation) + "\", or take a new database");
  }
  if (theirs->id != own.id) {
    return UnusableStore(
        "the uploads and results belong to another database",
        "give the right database (store.jobs) or the right objects (store.objects)");
  }
  if (theirs->generation > own.generation) {
    return UnusableStore(
        "the database is older than the uploads and results (start " +
            std::to_string(own.generation) + ", theirs " + std::to_string(theirs->generation) + ")",
        "put the right one back, or write the former number into the objects' file "
        "\"identity\"");
  }
  return Ok{};
}

// Of a database that no service has used yet.
Status BindFirst(JobStore& jobs, ObjectStore& objects) {
  const Result<std::unique_ptr<ObjectLock>> alone = jobs.HaltPins(true);
  if (!alone) return alone.error();
  if (!*alone) {
    return Error{ErrorCode::kIo, "another service is just starting on this database; try again",
                 "job-store-unusable"};
  }
  Result<StoreIdentity> own = jobs.Identity();
  if (!own) return std::move(own.error());
  if (own->generation > 0) return Ok{};  // another one was first
  Result<std::string> label = objects.ClaimLabel(WriteText(*own));
  if (!label) return std::move(label.error());
  Status fit = CheckFit(ParseIdentity(*label), *own);
  if (!fit) return fit;
  own = jobs.BeginGeneration();
  return own ? Status(Ok{}) : own.error();
}

}  // namespace

Status BindSharedStores(JobStore& jobs, ObjectStore& objects) {
  Result<StoreIdentity> own = jobs.Identity();
  if (!own) return std::move(own.error());
  if (own->generation == 0) {
    Status bound = BindFirst(jobs, objects);
    if (!bound) return bound;
    own = jobs.Identity();
    if (!own) return std::move(own.error());
  }
  Result<std::optional<StoreIdentity>> theirs = IdentityOf(objects);
  if (!theirs) return std::move(theirs.error());
  Status fit = CheckFit(*theirs, *own);
  if (!fit) return fit;
  own = jobs.BeginGeneration();
  Status counted = own ? objects.SetLabel(WriteText(*own)) : own.error();
  if (!counted) {
    Log(LogLevel::kWarning, "the start is not counted", {{"error", counted.error().message}});
  }
  return Ok{};
}

}  // namespace farhorizon
