#include "service/jobs/store_identity.h"

#include <filesystem>
#include <sstream>
#include <string>
#include <system_error>

#include "service/jobs/local_object_store.h"

namespace farhorizon {

namespace {

namespace fs = std::filesystem;

std::uintmax_t SizeOf(const fs::path& file) {
  std::error_code failure;
  const std::uintmax_t size = fs::file_size(file, failure);
  return failure ? 0 : size;
}

bool AnyObject(const fs::path& objects) {
  std::error_code failure;
  for (fs::recursive_directory_iterator it(objects, failure), end; !failure && it != end;
       it.increment(failure)) {
    if (IsSha256(it->path().filename().string())) return true;
  }
  return false;
}

}  // namespace

Error UnusableStore(const std::string& why, const std::string& remedy) {
  return {ErrorCode::kIo, "job store: " + why + "; " + remedy + ". Nothing was changed",
          "job-store-unusable"};
}

std::string WriteText(const StoreIdentity& identity) {
  return identity.id + " " + std::to_string(identity.generation) + "\n";
}

std::optional<StoreIdentity> ParseIdentity(const std::string& text) {
  std::istringstream words(text);
  StoreIdentity identity;
  if (words >> identity.id >> identity.generation) return identity;
  return std::nullopt;
}

std::optional<StoreIdentity> ReadIdentity(const DataDirectory& directory) {
  const Result<std::string> text = ReadLabel(directory.Objects());
  return text ? ParseIdentity(*text) : std::nullopt;
}

Status CheckDatabaseIsThere(const DataDirectory& directory) {
  if (SizeOf(directory.Jobs()) > 0) return Ok{};
  const bool log = SizeOf(directory.Jobs().string() + "-wal") > 0;
  if (!log && !fs::exists(LabelFile(directory.Objects())) && !AnyObject(directory.Objects()))
    return Ok{};
  return UnusableStore(
      "the database " + directory.Jobs().string() + " is missing or empty, but " +
          (log ? "its log is" : "uploads and results of a store are") +
          " beside it: without it, nobody knows whose they are",
      "put the database back from a backup, or move the data directory away to start "
      "afresh");
}

Status CheckSameStore(const DataDirectory& directory, JobStore& jobs, ObjectStore& objects) {
  const std::optional<StoreIdentity> beside = ReadIdentity(directory);
  Result<StoreIdentity> own = jobs.Identity();
  if (!own) return std::move(own.error());
  const std::string remedy = "put the right one back, or accept this one by `farhorizon fsck " +
                             directory.root.string() +
                             " --repair`, which sets aside what it does not know";
  if (beside && beside->id != own->id) {
    return UnusableStore("the uploads and results beside the database belong to another database",
                         remedy);
  }
  if (beside && beside->generation > own->generation) {
    return UnusableStore("the database is older than the uploads and results beside it (start " +
                             std::to_string(own->generation) + ", theirs " +
                             std::to_string(beside->generation) + ")",
                         remedy);
  }
  if (beside || own->generation == 0 || AnyObject(directory.Objects())) return Ok{};
  // Nothing at all is beside the database. That may be, unless its jobs have artifacts.
  Result<JobPage> newest = jobs.List({{JobState::kSuccessful, JobState::kAccepted}, {}, 1});
  if (!newest) return std::move(newest.error());
  if (newest->jobs.empty() || objects.Open(newest->jobs[0].input_sha256)) return Ok{};
  return UnusableStore(
      "the uploads and results of its jobs are gone from " + directory.Objects().string(),
      "mount or restore that folder; or let `farhorizon fsck " + directory.root.string() +
          " --repair` fail the jobs that have lost theirs");
}

Status WriteIdentity(const DataDirectory& directory, const StoreIdentity& identity) {
  return WriteLabel(directory.Objects(), WriteText(identity));
}

}  // namespace farhorizon
