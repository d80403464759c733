#pragma once

#include <chrono>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>

#include <nlohmann/json.hpp>

#include "core/base/result.h"
#include "service/cli/job_client.h"
#include "service/cli/reporter.h"
#include "service/url_query.h"

namespace farhorizon {

/// A DEM and what is asked for it.
struct RemoteSubmission {
  std::filesystem::path dem;
  Parameters parameters;
  std::string idempotency_key;
  std::function<void(double)> uploaded = {};  ///< called with the share that has been sent
};

/// Sends a DEM; the status of its job, which has its id in "jobID".
/// Errors: kNotFound where there is no such file; those of JobClient::SendForJson.
Result<nlohmann::json> SendDem(const JobClient& client, const RemoteSubmission& submission);

/// Waits until a job has ended; its last status. heard: called with each status on the way.
/// most: nullopt: as long as it takes.
/// Errors: kResourceExhausted "timeout" where it takes longer; kCancelled; those of JobClient.
Result<nlohmann::json> WaitForEnd(const JobClient& client, const std::string& id,
                                  const std::function<void(const nlohmann::json& status)>& heard,
                                  std::optional<std::chrono::seconds> most = {});

/// Shows how far the job with that status is.
void ShowProgress(const nlohmann::json& status, Reporter& reporter);

/// Succeeds for the status of a successful job.
/// Errors: why it failed; kUnsupportedData where it was dismissed.
Status SuccessOf(const nlohmann::json& status);

/// Makes the folder for artifacts where it is missing, and finds out whether it can be written.
/// Errors: kIo.
Status MakeFolder(const std::filesystem::path& directory);

/// Fetches a job's artifacts to `directory`, which is made if missing: what is there already is
/// not fetched again, what is there in part is gone on with. Each file is written beside its name,
/// compared with the manifest and renamed; manifest.json is the last. Where that is there, all are.
/// Errors: kIo where an artifact is not what the manifest says; those of JobClient.
Status FetchArtifacts(const JobClient& client, const std::string& id,
                      const std::filesystem::path& directory,
                      const std::function<void(double share)>& heard);

/// Whether `directory` has a manifest and all that it names, byte for byte.
bool HasArtifacts(const std::filesystem::path& directory);

/// The id in what a user calls a job by: the id, or its URL. Errors: kInvalidArgument.
Result<std::string> ReadJobId(const std::string& text);

}  // namespace farhorizon
