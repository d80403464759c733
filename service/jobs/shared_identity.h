#pragma once

#include "core/base/result.h"
#include "service/jobs/job_store.h"
#include "service/jobs/object_store.h"

namespace farhorizon {

/// Binds a database and a storage of objects that services share to one another, at the start of
/// each: at the first start of all the objects get the identity of the database, and afterwards
/// neither is used with another one. Counts the start.
/// Two first starts at once are one after the other, by the lock that keeps objects from being
/// removed; whoever is second finds the first one's objects, or refuses.
/// Errors: kIo "job-store-unusable", with the remedy; those of the stores.
Status BindSharedStores(JobStore& jobs, ObjectStore& objects);

}  // namespace farhorizon
