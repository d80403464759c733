#include <algorithm>
#include <array>
#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <mutex>
#include <sys/random.h>

#include <nlohmann/json.hpp>

#include "core/io/file.h"
#include "core/io/manifest.h"
#include "service/cli/command.h"
#include "service/cli/reporter.h"
#include "service/cli/signals.h"
#include "service/cli/wishes.h"
#include "service/http/client.h"
#include "service/jobs/job.h"
#include "service/log.h"

namespace farhorizon {

namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using std::chrono::milliseconds;

constexpr int kTries = 6;
constexpr milliseconds kFirstPause{100};
constexpr milliseconds kLongestPause{2000};

struct Call {
  std::string dem;
  std::string url;
  std::string directory;
  Wishes wishes;
  ReporterOptions reporter;
};

/// Waits, or stops waiting.
void Pause(milliseconds time, const std::stop_token& stop) {
  std::mutex mutex;
  std::condition_variable_any never;
  std::unique_lock lock(mutex);
  never.wait_for(lock, stop, time, [] { return false; });
}

std::string RandomKey() {
  std::array<std::uint32_t, 4> words{};
  Check(getrandom(words.data(), sizeof(words), 0) == static_cast<ssize_t>(sizeof(words)),
        "the kernel gives 16 random bytes");
  std::string key;
  for (const std::uint32_t word : words) key += std::to_string(word) + "-";
  return key;
}

/// What a problem document says, as an Error whose exit status fits.
Error Refusal(const ClientResponse& response) {
  const json problem = json::parse(response.body, nullptr, false);
  std::string detail = "the service answered " + std::to_string(response.status);
  std::string code;
  if (problem.is_object()) {
    if (problem.contains("code") && problem["code"].is_string()) code = problem["code"];
    if (problem.contains("detail") && problem["detail"].is_string()) {
      detail += " " + code + ": " + problem["detail"].get<std::string>();
    }
  }
  const bool call = response.status == 400 && code != "invalid-multipart";
  return {call                     ? ErrorCode::kInvalidArgument
          : response.status >= 500 ? ErrorCode::kIo
                                   : ErrorCode::kUnsupportedData,
          detail, code};
}

/// A conversation with a service about one job.
class Submission {
 public:
  Submission(ServiceUrl url, const Call& call, Reporter& reporter, std::stop_token stop)
      : url_(std::move(url)), call_(call), reporter_(reporter), stop_(std::move(stop)) {}

  Status Run() {
    Status sent = Send();
    if (!sent) return sent;
    Status finished = Wait();
    if (!finished) return finished;
    return Fetch();
  }

 private:
  /// Sends until there is an answer that is none of "try again".
  Result<ClientResponse> Ask(const ClientRequest& request) {
    milliseconds pause = kFirstPause;
    for (int tries = 1;; ++tries) {
      Result<ClientResponse> response = SendRequest(url_, request, stop_);
      const bool again = response ? response->status == 503 || response->status == 429
                                  : response.error().kind == "connection";
      if (!again || tries == kTries) return response;
      Pause(pause, stop_);
      if (stop_.stop_requested()) return Error{ErrorCode::kCancelled, "interrupted"};
      pause = std::min(2 * pause, kLongestPause);
    }
  }

  Result<json> AskJson(const std::string& target, int expected, ClientRequest request = {}) {
    request.target = target;
    Result<ClientResponse> response = Ask(request);
    if (!response) return std::move(response.error());
    if (response->status != expected) return Refusal(*response);
    json document = json::parse(response->body, nullptr, false);
    if (document.is_object()) return document;
    return Error{ErrorCode::kIo, "the service's answer is no JSON object; is it a farhorizon?"};
  }

  Status Send() {
    std::error_code failure;
    if (!fs::is_regular_file(call_.dem, failure)) {
      return Error{ErrorCode::kNotFound, "there is no file " + call_.dem};
    }
    Parameters query = call_.wishes.parameters;
    query["filename"] = SafeFilename(fs::path(call_.dem).filename().string());
    ClientRequest request;
    request.method = "POST";
    request.upload = call_.dem;
    request.headers = {{"Content-Type", "application/octet-stream"},
                       {"Idempotency-Key", "\"" + RandomKey() + "\""}};
    request.uploaded = [this](double share) { reporter_.Show("upload", share, 0); };
    Result<json> job = AskJson("/jobs?" + EncodeQuery(query), 201, request);
    if (!job) return std::move(job.error());
    id_ = job->value("jobID", "");
    if (IsJobId(id_)) return Done{};
    return Error{ErrorCode::kIo, "the service's answer names no job; is it a farhorizon?"};
  }

  Status Wait() {
    for (milliseconds pause = kFirstPause;; pause = std::min(pause * 3 / 2, kLongestPause)) {
      Result<json> job = AskJson("/jobs/" + id_, 200);
      if (!job) return std::move(job.error());
      const std::string status = job->value("status", "");
      const std::string stage = job->value("message", "");
      const int percent = job->value("progress", 0);
      reporter_.Show(stage, percent / 100.0, percent);
      if (status == "successful") return Done{};
      if (status == "dismissed") {
        return Error{ErrorCode::kUnsupportedData, "the job was dismissed by somebody"};
      }
      if (status == "failed") {  // its results tell why
        Result<json> why = AskJson("/jobs/" + id_ + "/results", 200);
        if (!why) return std::move(why.error());
        return Error{ErrorCode::kIo, "the job failed"};
      }
      Pause(pause, stop_);
      if (stop_.stop_requested()) {
        return Error{ErrorCode::kCancelled, "interrupted; the job goes on as /jobs/" + id_};
      }
    }
  }

  Status Fetch() {
    Result<json> results = AskJson("/jobs/" + id_ + "/results", 200);
    if (!results) return std::move(results.error());
    std::error_code failure;
    fs::create_directories(call_.directory, failure);
    if (failure) {
      return Error{ErrorCode::kIo,
                   "cannot make the folder " + call_.directory + ": " + failure.message()};
    }
    Status fetched = Done{};
    std::vector<std::string> names;
    for (const auto& [name, link] : results->items()) {
      if (fetched) fetched = FetchOne(name, names);
    }
    if (fetched) fetched = CheckAgainstManifest(names);
    for (const std::string& name : names) {
      const fs::path part = PartOf(name);
      if (fetched) fs::rename(part, fs::path(call_.directory) / name, failure);
      if (!fetched || failure) fs::remove(part, failure);
    }
    return fetched;
  }

  [[nodiscard]] fs::path PartOf(const std::string& name) const {
    return fs::path(call_.directory) / (name + ".part");
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
    Result<ClientResponse> response = Ask(request);
    if (!response) return std::move(response.error());
    if (response->status != 200) return Refusal(*response);
    return Done{};
  }

  Status CheckAgainstManifest(const std::vector<std::string>& names) {
    Result<std::string> text = ReadFile(PartOf("manifest.json"));
    if (!text) return std::move(text.error()).Within("manifest.json");
    Result<std::vector<ManifestEntry>> entries = ReadManifest(*text);
    if (!entries) return std::move(entries.error()).Within("manifest.json");
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
    return Done{};
  }

  ServiceUrl url_;
  const Call& call_;
  Reporter& reporter_;
  std::stop_token stop_;
  std::string id_;
};

int Run(const Call& call) {
  Result<ServiceUrl> url = ReadServiceUrl(call.url);
  if (!url) return Complain(url.error());
  // Said here already, without sending anything.
  Result<BuildOptions> options = call.wishes.Options();
  if (!options) return Complain(options.error());
  const StopOnSignal signals;
  Reporter reporter(call.reporter);
  Status done = Submission(*url, call, reporter, signals.token()).Run();
  reporter.Clear();
  return done ? kExitDone : Complain(done.error());
}

}  // namespace

void AddSubmit(CLI::App& app, Chosen& chosen) {
  const auto call = std::make_shared<Call>();
  CLI::App* command =
      app.add_subcommand("submit", "Send a DEM to a service and fetch the artifacts");
  command->add_option("DEM", call->dem, "GeoTIFF, ASCII grid, SRTM HGT, DTED or USGS DEM")
      ->required()
      ->type_name("");
  command->add_option("--url", call->url, "the service: http://HOST:PORT")
      ->required()
      ->type_name("URL");
  command->add_option("-o,--output", call->directory, "folder for the artifacts; made if missing")
      ->required()
      ->type_name("DIR");
  AddBuildWishes(*command, call->wishes);
  AddReporterOptions(*command, call->reporter);
  command->callback([call, &chosen] { chosen = [call] { return Run(*call); }; });
}

}  // namespace farhorizon
