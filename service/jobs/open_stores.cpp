#include "service/jobs/open_stores.h"

#include <chrono>
#include <utility>

#include "core/base/hex.h"
#include "core/io/file.h"
#include "service/jobs/local_object_store.h"
#include "service/jobs/postgres_job_store.h"
#include "service/jobs/sqlite_job_store.h"
#include "service/jobs/store_identity.h"
#include "service/log.h"
#include "service/random.h"

namespace farhorizon {

namespace {

constexpr std::size_t kHolderDigits = 32;

// The name of the processes that follow one another on this folder, in a file of it.
Result<std::string> HolderOf(const DataDirectory& directory) {
  const std::filesystem::path file = directory.root / "holder";
  Result<std::string> text = ReadFile(file, kHolderDigits + 1);
  const auto valid = [](const std::string& name) {
    return name.size() == kHolderDigits &&
           name.find_first_not_of("0123456789abcdef") == std::string::npos;
  };
  if (text && valid(*text)) return text;
  std::string name = ToHex(RandomBytes());
  Check(valid(name), "a holder's name is hexadecimal");
  Status written = WriteFile(file, name);
  if (!written) return std::move(written.error());
  return name;
}

Result<std::unique_ptr<JobStore>> OpenJobs(const DataDirectory& directory,
                                           const StoreOptions& options) {
  if (options.jobs.empty()) {
    Status there = CheckDatabaseIsThere(directory);
    if (!there) return std::move(there.error());
    return OpenSqliteJobStore(directory.Jobs());
  }
  Result<std::string> holder = HolderOf(directory);
  if (!holder) return std::move(holder.error());
  return OpenPostgresJobStore(
      {options.jobs, *holder, std::chrono::seconds(options.lease_seconds), options.connections});
}

}  // namespace

Status CheckStoreOptions(const StoreOptions& options) {
  if (options.jobs.empty() == options.objects.empty()) return Ok{};
  return Error{ErrorCode::kInvalidArgument,
               "store.jobs and store.objects go together: give both, for services that share them, "
               "or neither",
               "invalid-config"};
}

Result<Stores> OpenStores(DataDirectory& directory, const StoreOptions& options) {
  Status fit = CheckStoreOptions(options);
  if (!fit) return std::move(fit.error());
  // The process may change its folder.
  if (!options.objects.empty()) {
    std::error_code failure;
    directory.shared_objects = std::filesystem::absolute(options.objects, failure);
  }
  Result<std::unique_ptr<JobStore>> jobs = OpenJobs(directory, options);
  if (!jobs) return std::move(jobs.error());
  const Sharing sharing = options.objects.empty() ? Sharing::kOneProcess : Sharing::kManyProcesses;
  Result<std::unique_ptr<ObjectStore>> objects = OpenLocalObjectStore(directory.Objects(), sharing);
  if (!objects) return std::move(objects.error());
  Status same = CheckSameStore(directory, **jobs, **objects);
  if (!same) return std::move(same.error());
  Result<StoreIdentity> identity = (*jobs)->BeginGeneration();
  Status written = identity ? WriteIdentity(directory, *identity) : Status(identity.error());
  if (!written) {
    Log(LogLevel::kWarning, "the start is not counted", {{"error", written.error().message}});
  }
  return Stores{*std::move(jobs), *std::move(objects)};
}

}  // namespace farhorizon
