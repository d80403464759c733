#include <algorithm>
#include <chrono>
#include <filesystem>
#include <memory>
#include <set>
#include <system_error>
#include <vector>

#include <nlohmann/json.hpp>

#include "core/base/hex.h"
#include "core/io/file.h"
#include "core/io/manifest.h"
#include "service/cli/client_key.h"
#include "service/cli/command.h"
#include "service/cli/dem_command.h"
#include "service/cli/job_client.h"
#include "service/clock.h"
#include "service/jobs/job.h"
#include "service/random.h"

namespace farhorizon {

namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using std::chrono::milliseconds;

constexpr milliseconds kFirstPause{100};
constexpr milliseconds kLongestPause{2000};

struct SubmitArguments {
  DemArguments dem;
  std::string url;
  std::string directory;
  std::string key_file;
};

// One job of a service: sends the DEM, waits for the end and fetches the artifacts.
class RemoteJob {
 public:
  RemoteJob(const ServiceUrl& url, const std::string& key, const SubmitArguments& arguments,
            const DemRun& run)
      : client_(url, key, run.control.stop),
        arguments_(arguments),
        reporter_(run.reporter),
        control_(run.control) {}

  Status Run() {
    Status sent = Send();
    if (!sent) return sent;
    Status finished = Wait();
    if (!finished) return finished;
    return Fetch();
  }

 private:
  Status Send() {
    std::error_code failure;
    const std::string& dem = arguments_.dem.path;
    if (!fs::is_regular_file(dem, failure)) {
      return Error{ErrorCode::kNotFound, "there is no file " + dem};
    }
    Parameters query = arguments_.dem.flags.parameters;
    query["filename"] = SafeFilename(fs::path(dem).filename().string());
    ClientRequest request;
    request.method = "POST";
    request.upload = dem;
    request.headers = {{"Content-Type", "application/octet-stream"},
                       {"Idempotency-Key", "\"" + ToHex(RandomBytes()) + "\""}};
    request.uploaded = [this](double share) { reporter_.Show("upload", share, 0); };
    Result<json> job = client_.SendForJson("/jobs?" + EncodeQuery(query), 201, request);
    if (!job) return std::move(job.error());
    id_ = job->value("jobID", "");
    if (!IsJobId(id_)) {
      return Error{ErrorCode::kIo, "the service's answer names no job; is it a farhorizon?"};
    }
    SayAssumptions(*job);
    return Ok{};
  }

  // Each once, of a list that grows, and begins anew where the job is run again.
  void SayAssumptions(const json& job) {
    const auto list = job.find("assumptions");
    if (list == job.end() || !list->is_array()) return;
    for (const json& one : *list) {
      if (!one.is_object()) continue;
      const Assumption assumption{one.value("code", ""), one.value("text", "")};
      if (said_.insert(assumption.text).second) control_.Assume(assumption);
    }
  }

  Status Wait() {
    for (milliseconds pause = kFirstPause;; pause = std::min(pause * 3 / 2, kLongestPause)) {
      Result<json> job = client_.SendForJson("/jobs/" + id_, 200);
      if (!job) return std::move(job.error());
      SayAssumptions(*job);
      const std::string status = job->value("status", "");
      const std::string stage = job->value("message", "");
      const int percent = job->value("progress", 0);
      reporter_.Show(stage, percent / 100.0, percent);
      if (status == "successful") return Ok{};
      if (status == "dismissed") {
        return Error{ErrorCode::kUnsupportedData, "the job was dismissed by somebody"};
      }
      if (status == "failed") {  // asking for its results answers the failure
        Result<json> why = client_.SendForJson("/jobs/" + id_ + "/results", 200);
        if (!why) return std::move(why.error());
        return Error{ErrorCode::kIo, "the job failed"};
      }
      Pause(pause, control_.stop);
      if (control_.StopRequested()) {
        return Error{ErrorCode::kCancelled, "interrupted; the job goes on as /jobs/" + id_};
      }
    }
  }

  Status Fetch() {
    Result<json> results = client_.SendForJson("/jobs/" + id_ + "/results", 200);
    if (!results) return std::move(results.error());
    std::error_code failure;
    fs::create_directories(arguments_.directory, failure);
    if (failure) {
      return Error{ErrorCode::kIo,
                   "cannot make the folder " + arguments_.directory + ": " + failure.message()};
    }
    Status fetched = Ok{};
    std::vector<std::string> names;
    for (const auto& [name, link] : results->items()) {
      if (fetched) fetched = FetchOne(name, names);
    }
    if (fetched) fetched = CheckAgainstManifest(names);
    for (const std::string& name : names) {
      const fs::path part = PartOf(name);
      if (fetched) fs::rename(part, fs::path(arguments_.directory) / name, failure);
      if (!fetched || failure) fs::remove(part, failure);
    }
    return fetched;
  }

  [[nodiscard]] fs::path PartOf(const std::string& name) const {
    return fs::path(arguments_.directory) / (name + ".part");
  }

  Status FetchOne(const std::string& name, std::vector<std::string>& names) {
    if (!IsArtifactName(name)) {
      return Error{ErrorCode::kIo, "the service names an artifact that cannot be a file"};
    }
    reporter_.Show("download", 1, 100);
    names.push_back(name);
    ClientRequest request;
    request.target = "/jobs/" + id_ + "/results/" + name;
    request.download = PartOf(name);
    Result<ClientResponse> response = client_.Send(request);
    if (!response) return std::move(response.error());
    if (response->status != 200) return ErrorOfProblem(*response);
    return Ok{};
  }

  Status CheckAgainstManifest(const std::vector<std::string>& names) {
    Result<std::string> text = ReadFile(PartOf("manifest.json"));
    if (!text) return std::move(text.error()).WithContext("manifest.json");
    Result<std::vector<ManifestEntry>> entries = ReadManifest(*text);
    if (!entries) return std::move(entries.error()).WithContext("manifest.json");
    for (const ManifestEntry& entry : *entries) {
      Result<std::string> found = Error{ErrorCode::kNotFound, "it was not fetched"};
      if (std::find(names.begin(), names.end(), entry.name) != names.end()) {
        found = Sha256OfFile(PartOf(entry.name));
      }
      if (!found || *found != entry.sha256) {
        return Error{ErrorCode::kIo,
                     entry.name + " is not what manifest.json says; fetch it again"};
      }
    }
    return Ok{};
  }

  JobClient client_;
  const SubmitArguments& arguments_;
  Reporter& reporter_;
  const RunControl& control_;
  std::string id_;
  std::set<std::string> said_;
};

int Run(const SubmitArguments& arguments) {
  Result<ServiceUrl> url = ReadServiceUrl(arguments.url);
  if (!url) return ReportError(url.error());
  const Result<std::string> key = ReadClientKey(arguments.key_file, *url);
  if (!key) return ReportError(key.error());
  // RunOnDem refuses invalid flags before anything is sent.
  return ExitStatusOf(RunOnDem(arguments.dem, Workflow::kBuild, [&](const DemRun& run) {
    return RemoteJob(*url, *key, arguments, run).Run();
  }));
}

}  // namespace

void AddSubmit(Command& program, SelectedCommand& selected) {
  const auto arguments = std::make_shared<SubmitArguments>();
  Command command = program.AddCommand("submit", "Send a DEM to a service and fetch the artifacts");
  AddDem(command, arguments->dem,
         "GeoTIFF, text grid (Arc/Info, GRASS, Surfer, x y z), SRTM HGT, also zipped, DTED, USGS "
         "DEM, Erdas Imagine or Surfer");
  command.Add(
      {.names = "--url", .type = "URL", .help = "the service: http://HOST:PORT", .required = true},
      arguments->url);
  command.Add({.names = "-o,--output",
               .type = "DIR",
               .help = "folder for the artifacts; made if missing",
               .required = true},
              arguments->directory);
  command.Add(
      {.names = "--key-file",
       .type = "FILE",
       .help = "the file with the key, where the service asks for one (the key in "
               "FARHORIZON_KEY). There is no flag for a key itself: who lists the processes "
               "would see it"},
      arguments->key_file);
  AddBuildFlags(command, arguments->dem.flags);
  AddReporterOptions(command, arguments->dem.reporter);
  command.Select(selected, [arguments] { return Run(*arguments); });
}

}  // namespace farhorizon
