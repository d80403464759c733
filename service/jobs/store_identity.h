#pragma once

#include <optional>
#include <string>

#include "core/base/result.h"
#include "service/jobs/data_directory.h"
#include "service/jobs/job_store.h"
#include "service/jobs/object_store.h"

namespace farhorizon {

/// Database and objects belong together: a database that does not know the objects beside it would
/// take them for garbage. So the folder of the objects has the identity of its store in a file.

/// Succeeds unless the database is missing or empty while there are objects, or their identity.
/// To be called before the database is opened, which makes it.
/// Errors: kIo "job-store-unusable", with the remedy.
Status CheckDatabaseIsThere(const DataDirectory& directory);

/// Succeeds if the objects are those of this database, and the database is no older one than that
/// which they were used with last.
/// Errors: kIo "job-store-unusable", with the remedy.
Status CheckSameStore(const DataDirectory& directory, JobStore& jobs, ObjectStore& objects);

/// "job-store-unusable": why, and the remedy.
Error UnusableStore(const std::string& why, const std::string& remedy);

/// An identity as a line of text, and back; nullopt for any other text.
std::string WriteText(const StoreIdentity& identity);
std::optional<StoreIdentity> ParseIdentity(const std::string& text);

/// The identity beside the objects; nullopt where there is none that can be read.
std::optional<StoreIdentity> ReadIdentity(const DataDirectory& directory);
/// Writes the identity beside the objects. Errors: those of WriteFile.
Status WriteIdentity(const DataDirectory& directory, const StoreIdentity& identity);

}  // namespace farhorizon
