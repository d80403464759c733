#include "service/jobs/open_stores.h"

#include <chrono>
#include <utility>

#include "core/base/hex.h"
#include "core/io/file.h"
#include "service/jobs/database_url.h"
#include "service/jobs/local_object_store.h"
#include "service/jobs/postgres_job_store.h"
#include "service/jobs/s3_object_store.h"
#include "service/jobs/shared_identity.h"
#include "service/jobs/sqlite_job_store.h"
#include "service/jobs/store_identity.h"
#include "service/log.h"
#include "service/random.h"
#include "service/s3/s3_credentials.h"

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

Error Invalid(const std::string& why) {
  return {ErrorCode::kInvalidArgument, why, "invalid-config"};
}

std::filesystem::path Absolute(const std::filesystem::path& path) {
  std::error_code failure;
  const std::filesystem::path canonical = std::filesystem::weakly_canonical(path, failure);
  return AbsolutePath(failure ? path : canonical);
}

Result<std::unique_ptr<ObjectStore>> OpenObjects(const DataDirectory& directory,
                                                 const StoreOptions& options,
                                                 std::int64_t least_free_bytes) {
  if (options.objects.empty()) return OpenLocalObjectStore(directory.Objects());
  if (!IsS3Url(options.objects)) {
    // The process may change its folder.
    return OpenLocalObjectStore(Absolute(options.objects), Sharing::kManyProcesses);
  }
  Result<S3Location> location = ReadS3Location(options.objects, options.s3, AwsEnvironment());
  if (!location) return std::move(location.error());
  return OpenS3ObjectStore({*location, options.s3.credentials, directory.Cache(),
                            options.cache_bytes, least_free_bytes});
}

// The objects are this database's, and the start is counted.
Status Bind(const DataDirectory& directory, JobStore& jobs, ObjectStore& objects) {
  Status same = CheckSameStore(directory, jobs, objects);
  if (!same) return same;
  Result<StoreIdentity> identity = jobs.BeginGeneration();
  Status written = identity ? WriteIdentity(directory, *identity) : Status(identity.error());
  if (!written) {
    Log(LogLevel::kWarning, "the start is not counted", {{"error", written.error().message}});
  }
  return Ok{};
}

}  // namespace

Status CheckStoreOptions(const StoreOptions& options, const std::filesystem::path& data) {
  if (options.jobs.empty() != options.objects.empty()) {
    return Invalid(
        "store.jobs and store.objects go together: give both, for services that share them, or "
        "neither");
  }
  if (options.jobs.empty()) return Ok{};
  Status url = CheckDatabaseUrl(options.jobs);
  if (!url) return url;
  if (IsS3Url(options.objects)) {
    Result<S3Location> location = ReadS3Location(options.objects, options.s3, AwsEnvironment());
    if (!location) return std::move(location.error());
    Result<S3Keys> keys = S3Credentials(options.s3.credentials, AwsEnvironment()).Current();
    return keys ? Status(Ok{}) : std::move(keys.error());
  }
  if (options.objects.find("://") != std::string::npos) {
    return Invalid("store.objects is \"" + options.objects +
                   "\": give a folder, or s3://BUCKET or s3://BUCKET/PREFIX");
  }
  if (Absolute(options.objects) == Absolute(data)) {
    return Invalid(
        "store.objects and data are the same folder: the former is for all services, the latter "
        "for this process alone; give two folders");
  }
  return Ok{};
}

Result<Stores> OpenStores(const DataDirectory& directory, const StoreOptions& options,
                          std::int64_t least_free_bytes) {
  Status fit = CheckStoreOptions(options, directory.root);
  if (!fit) return std::move(fit.error());
  Result<std::unique_ptr<JobStore>> jobs = OpenJobs(directory, options);
  if (!jobs) return std::move(jobs.error());
  Result<std::unique_ptr<ObjectStore>> objects = OpenObjects(directory, options, least_free_bytes);
  if (!objects) return std::move(objects.error());
  Status bound = options.objects.empty() ? Bind(directory, **jobs, **objects)
                                         : BindSharedStores(**jobs, **objects);
  if (!bound) return std::move(bound.error());
  return Stores{*std::move(jobs), *std::move(objects)};
}

}  // namespace farhorizon
