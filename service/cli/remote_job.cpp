#include "service/cli/remote_job.h"

#include <algorithm>
#include <cerrno>
#include <set>
#include <string_view>
#include <system_error>
#include <unistd.h>
#include <utility>
#include <vector>

#include "core/io/file.h"
#include "core/io/manifest.h"
#include "core/io/posix_file.h"
#include "core/io/sha256.h"
#include "service/clock.h"
#include "service/jobs/collect_artifacts.h"
#include "service/jobs/job.h"

namespace farhorizon {

namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using std::chrono::milliseconds;
using std::chrono::seconds;
using Clock = std::chrono::steady_clock;

constexpr const char* kManifest = "manifest.json";
constexpr milliseconds kFirstPollPause{100};
constexpr milliseconds kLongestPollPause{2000};
// Less than the client's patience with a silent connection.
constexpr int kLongPollSeconds = 20;

// Of a file that is not there whole yet.
constexpr std::string_view kPart = ".part";

fs::path PartOf(const fs::path& file) { return file.string() + std::string(kPart); }

// A manifest that a service has sent, whoever that is: what it names can be files of one folder,
// none of them another's beginning.
Result<std::vector<ManifestEntry>> ReadTheirManifest(const std::string& text) {
  const auto wrong = [](const std::string& why) {
    return Error{ErrorCode::kIo, "manifest.json, as the service sends it, " + why, "bad-manifest"};
  };
  Result<std::vector<ManifestEntry>> entries = ReadManifest(text);
  if (!entries) return wrong("cannot be read; is it a farhorizon?");
  if (entries->size() > kMostArtifacts) {
    return wrong("names more than " + std::to_string(kMostArtifacts) + " files");
  }
  std::set<std::string> names = {kManifest};
  for (const ManifestEntry& entry : *entries) {
    if (!IsArtifactName(entry.name)) return wrong("names an artifact that cannot be a file");
    if (entry.name.ends_with(kPart)) {
      return wrong("names " + entry.name + ", as a file is called that is not there whole yet");
    }
    if (!names.insert(entry.name).second) return wrong("names " + entry.name + " twice");
  }
  return entries;
}

bool IsWhole(const fs::path& file, const ManifestEntry& entry) {
  std::error_code failure;
  const bool same_size = fs::file_size(file, failure) == entry.bytes && !failure;
  if (!same_size) return false;
  const Result<std::string> found = Sha256OfFile(file);
  return found && *found == entry.sha256;
}

// Fetches the artifact to the file `part`, which may have its beginning.
Status FetchPart(const JobClient& client, const std::string& target, const ManifestEntry& entry,
                 const fs::path& part) {
  std::error_code failure;
  const std::uintmax_t have = fs::file_size(part, failure);
  if (!failure && have >= entry.bytes) fs::remove(part, failure);
  ClientRequest request;
  request.target = target;
  request.download = part;
  request.most_bytes = entry.bytes;
  request.resumes = "\"" + entry.sha256 + "\"";
  const Result<ClientResponse> response = client.Send(std::move(request));
  if (!response) {
    if (response.error().kind == "result-corrupt") fs::remove(part, failure);
    return Error(response.error()).WithContext(entry.name);
  }
  if (response->status != 200 && response->status != 206) {
    return ErrorOfProblem(*response).WithContext(entry.name);
  }
  if (IsWhole(part, entry)) return Ok{};
  fs::remove(part, failure);
  return Error{ErrorCode::kIo, entry.name + " is not what manifest.json says; fetch it again",
               "result-corrupt"};
}

Status FetchOne(const JobClient& client, const std::string& results, const ManifestEntry& entry,
                const fs::path& directory) {
  const fs::path file = directory / entry.name;
  if (IsWhole(file, entry)) return Ok{};
  const fs::path part = PartOf(file);
  std::error_code failure;
  const bool begun = fs::exists(part, failure);
  if (!IsWhole(part, entry)) {
    const std::string target = results + "/" + entry.name;
    Status fetched = FetchPart(client, target, entry, part);
    // What was begun may be another job's.
    const bool again = !fetched && begun && fetched.error().kind == "result-corrupt";
    if (again) fetched = FetchPart(client, target, entry, part);
    if (!fetched) return fetched;
  }
  fs::rename(part, file, failure);
  if (!failure) return Ok{};
  return Error{ErrorCode::kIo, "cannot write " + file.string() + ": " + failure.message()};
}

}  // namespace

Result<json> SendDem(const JobClient& client, const RemoteSubmission& submission) {
  std::error_code failure;
  if (!fs::is_regular_file(submission.dem, failure)) {
    return Error{ErrorCode::kNotFound, "there is no file " + submission.dem.string()};
  }
  Parameters query = submission.parameters;
  query["filename"] = SafeFilename(submission.dem.filename().string());
  ClientRequest request;
  request.method = "POST";
  request.upload = submission.dem;
  request.headers = {{"Content-Type", "application/octet-stream"},
                     {"Idempotency-Key", "\"" + submission.idempotency_key + "\""}};
  request.uploaded = submission.uploaded;
  Result<json> job = client.SendForJson("/jobs?" + EncodeQuery(query), 201, std::move(request));
  if (job && !IsJobId(TextOf(*job, "jobID"))) {
    return Error{ErrorCode::kIo, "the service's answer names no job; is it a farhorizon?"};
  }
  return job;
}

Result<json> WaitForEnd(const JobClient& client, const std::string& id,
                        const std::function<void(const json& status)>& heard,
                        std::optional<seconds> most) {
  const Clock::time_point start = Clock::now();
  std::string tag;
  milliseconds pause = kFirstPollPause;
  for (;;) {
    const auto left =
        most ? std::chrono::ceil<seconds>(start + *most - Clock::now()) : seconds(kLongPollSeconds);
    ClientRequest request;
    request.target = "/jobs/" + id;
    const bool asks_to_wait = !tag.empty() && left.count() > 0;
    if (asks_to_wait) {
      request.headers = {{"If-None-Match", tag},
                         {"Prefer", "wait=" + std::to_string(std::min<std::int64_t>(
                                                  left.count(), kLongPollSeconds))}};
    }
    const Result<ClientResponse> response = client.Send(std::move(request));
    if (client.stop().stop_requested()) {
      return Error{ErrorCode::kCancelled, "interrupted; the job goes on as /jobs/" + id};
    }
    if (!response) return response.error();
    if (response->status != 304) {
      if (response->status != 200) return ErrorOfProblem(*response);
      Result<json> status = JsonOf(*response);
      if (!status) return status;
      heard(*status);
      const std::optional<JobState> state = JobStateOf(TextOf(*status, "status"));
      if (state && IsTerminal(*state)) return status;
      tag = response->Header("etag");
    }
    if (most && Clock::now() >= start + *most) {
      return Error{ErrorCode::kResourceExhausted,
                   "the job has not ended yet; it goes on as /jobs/" + id, "timeout"};
    }
    // A service that does not wait is not to be asked again without a pause.
    if (!asks_to_wait || !response->Header("preference-applied").empty()) continue;
    Pause(pause, client.stop());
    pause = std::min(pause * 3 / 2, kLongestPollPause);
  }
}

void ShowProgress(const json& status, Reporter& reporter) {
  const auto progress = status.find("progress");
  const bool known = progress != status.end() && progress->is_number_integer();
  const int percent = std::clamp(known ? progress->get<int>() : 0, 0, 100);
  reporter.Show(TextOf(status, "message"), percent / 100.0, percent);
}

Status SuccessOf(const json& status) {
  const std::string state = TextOf(status, "status");
  if (state == "successful") return Ok{};
  if (state == "dismissed") {
    return Error{ErrorCode::kUnsupportedData, "the job was dismissed by somebody"};
  }
  const auto why = status.find("exception");
  if (state != "failed" || why == status.end() || !why->is_object()) {
    return Error{ErrorCode::kIo, "the job is " + state};
  }
  const std::string code = TextOf(*why, "code");
  const auto number = why->find("status");
  const bool theirs = number != why->end() && number->is_number_integer() && *number < 500;
  return Error{theirs ? ErrorCode::kUnsupportedData : ErrorCode::kIo,
               "the job failed: " + code + ": " + TextOf(*why, "detail"),
               ErrorKind::FromName(code).value_or(ErrorKind())};
}

Status MakeFolder(const fs::path& directory) {
  std::error_code failure;
  fs::create_directories(directory, failure);
  if (failure) {
    return Error{ErrorCode::kIo,
                 "cannot make the folder " + directory.string() + ": " + failure.message()};
  }
  if (::access(directory.c_str(), W_OK | X_OK) == 0) return Ok{};
  return ErrorFromErrno("write to the folder " + directory.string(), errno);
}

Status FetchArtifacts(const JobClient& client, const std::string& id, const fs::path& directory,
                      const std::function<void(double share)>& heard) {
  const std::string results = "/jobs/" + id + "/results";
  ClientRequest request;
  request.target = results + "/" + kManifest;
  const Result<ClientResponse> manifest = client.Send(std::move(request));
  if (!manifest) return manifest.error();
  if (manifest->status != 200) return ErrorOfProblem(*manifest);
  const Result<std::vector<ManifestEntry>> entries = ReadTheirManifest(manifest->body);
  if (!entries) return entries.error();
  if (Status made = MakeFolder(directory); !made) return made;
  double fetched = 0;
  for (const ManifestEntry& entry : *entries) {
    heard(fetched++ / static_cast<double>(entries->size()));
    if (Status one = FetchOne(client, results, entry, directory); !one) return one;
  }
  heard(1);
  return WriteFile(directory / kManifest, manifest->body);
}

bool HasArtifacts(const fs::path& directory) {
  const Result<std::string> text = ReadFile(directory / kManifest);
  if (!text) return false;
  const Result<std::vector<ManifestEntry>> entries = ReadTheirManifest(*text);
  return entries && std::ranges::all_of(*entries, [&](const ManifestEntry& entry) {
           return IsWhole(directory / entry.name, entry);
         });
}

Result<std::string> ReadJobId(const std::string& text) {
  std::string_view id = text;
  while (!id.empty() && id.back() == '/') id.remove_suffix(1);
  id.remove_prefix(id.rfind('/') + 1);  // npos + 1 is 0
  if (IsJobId(id)) return std::string(id);
  return Error{ErrorCode::kInvalidArgument,
               "\"" + text + "\" is no job's id; submit and GET /jobs say the ids"};
}

}  // namespace farhorizon
