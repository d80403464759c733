#include "service/jobs/fsck/backup_store.h"

#include <cerrno>
#include <fcntl.h>
#include <string>
#include <sys/stat.h>
#include <system_error>
#include <unistd.h>
#include <vector>

#include "core/io/file.h"
#include "core/io/posix_file.h"
#include "service/auth/auth_options.h"
#include "service/jobs/object_store.h"
#include "service/jobs/sqlite.h"
#include "service/jobs/storage_file.h"

namespace farhorizon {

namespace {

namespace fs = std::filesystem;

Error Unusable(const std::string& why) { return {ErrorCode::kIo, why, "data-directory"}; }

// A copy of the database as of one moment, without a log beside it. Throws SqlFailure.
void CopyDatabase(const fs::path& source, const fs::path& target) {
  Database database;
  database.Open(source);
  Statement(database, "VACUUM INTO ?").Bind(target.string()).Run();
}

std::vector<std::string> NamedObjects(const fs::path& database_file) {
  Database database;
  database.Open(database_file);
  Statement rows(database,
                 "SELECT input_sha256 FROM jobs UNION SELECT sha256 FROM artifacts "
                 "UNION SELECT gzip_sha256 FROM artifacts WHERE gzip_sha256 IS NOT NULL "
                 "UNION SELECT zstd_sha256 FROM artifacts WHERE zstd_sha256 IS NOT NULL "
                 "UNION SELECT sha256 FROM upload_parts "
                 "UNION SELECT sha256 FROM uploads WHERE sha256 IS NOT NULL");
  std::vector<std::string> names;
  while (rows.Step()) names.push_back(rows.Text(0));
  return names;
}

Status CopyBytes(int from, int to) {
  Status copied = ForEachPiece(from, "read an object", [to](std::string_view piece) -> Status {
    if (!WriteAll(to, piece)) return StorageError("write an object");
    return Ok{};
  });
  return copied ? SyncFile(to, "sync an object") : copied;
}

// Copies an object if it is there: the check of the copy tells which are not.
Status CopyObject(const fs::path& source, const fs::path& target, const std::string& name) {
  Result<UniqueFd> from = OpenForReading(source / name.substr(0, 2) / name);
  if (!from && from.error().code == ErrorCode::kNotFound) return Ok{};
  if (!from) return std::move(from.error());
  const fs::path folder = target / name.substr(0, 2);
  if (::mkdir(folder.c_str(), 0700) != 0 && errno != EEXIST) return StorageError("make a folder");
  const UniqueFd to(::open((folder / name).c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0400));
  if (!to) return StorageError("make an object");
  return CopyBytes(from->get(), to.get());
}

// The hashes of keys, where there are some.
Status CopyKeys(const fs::path& source, const fs::path& target) {
  const Result<std::string> keys = ReadFile(AuthOptions{}.KeysFile(source));
  if (!keys) return keys.error().code == ErrorCode::kNotFound ? Status(Ok{}) : keys.error();
  return WriteFile(AuthOptions{}.KeysFile(target), *keys);
}

Status CopyAll(const fs::path& source, const fs::path& target) {
  // The database first: an object that a row names is there before the row.
  CopyDatabase(source / "jobs.sqlite", target / "jobs.sqlite");
  Status keys = CopyKeys(source, target);
  if (!keys) return keys;
  for (const std::string& name : NamedObjects(target / "jobs.sqlite")) {
    if (!IsSha256(name)) continue;
    Status copied = CopyObject(source / "objects", target / "objects", name);
    if (!copied) return copied;
  }
  return Ok{};
}

}  // namespace

Result<FsckSum> BackUpStore(const FsckOptions& source, const fs::path& target) {
  std::error_code failure;
  if (!fs::exists(source.data / "jobs.sqlite", failure)) {
    return Unusable(source.data.string() + " has no store of farhorizon");
  }
  if (fs::exists(target, failure) && !fs::is_empty(target, failure)) {
    return Unusable(target.string() + " is there already; give a new folder");
  }
  fs::create_directories(target / "objects", failure);
  if (failure) return Unusable("cannot make " + target.string() + ": " + failure.message());
  for (const fs::path& folder : {target, target / "objects"}) ::chmod(folder.c_str(), 0700);
  try {
    Status copied = CopyAll(source.data, target);
    if (!copied) return std::move(copied.error());
  } catch (SqlFailure& failed) {
    return std::move(failed.error);
  }
  return CheckStore({target, true, source.say});
}

}  // namespace farhorizon
