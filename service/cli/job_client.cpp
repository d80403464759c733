#include "service/cli/job_client.h"

#include <algorithm>
#include <charconv>

#include "core/geo/short_text.h"
#include "service/cli/client_key.h"
#include "service/cli/command.h"
#include "service/clock.h"
#include "service/random.h"

namespace farhorizon {

namespace {

using nlohmann::json;
using std::chrono::milliseconds;
using Clock = std::chrono::steady_clock;

constexpr milliseconds kFirstPause{100};
constexpr milliseconds kLongestPause{5000};

// Between a half and the whole of `pause`, so that clients that were cut off together do not come
// back together; as long as the service asks for, if it is in reach.
milliseconds PauseBeforeNext(milliseconds pause, const Result<ClientResponse>& response) {
  const unsigned char chance = RandomBytes()[0];
  const milliseconds drawn = pause / 2 + pause * chance / 512;
  int seconds = 0;
  if (response) {
    const std::string asked = response->Header("retry-after");
    std::from_chars(asked.data(), asked.data() + asked.size(), seconds);
  }
  return std::max(drawn, std::min(milliseconds(1000 * std::clamp(seconds, 0, 60)), 60 * pause));
}

}  // namespace

void AddServiceOptions(Command& command, ServiceArguments& arguments) {
  command.Add(
      {.names = "--url", .type = "URL", .help = "the service: http://HOST:PORT", .required = true},
      arguments.url);
  command.Add(
      {.names = "--key-file",
       .type = "FILE",
       .help = "the file with the key, where the service asks for one (the key in "
               "FARHORIZON_KEY). There is no flag for a key itself: who lists the processes "
               "would see it"},
      arguments.key_file);
  command.Add({.names = "--patience",
               .type = "SECONDS",
               .help = "for how long a request is sent again while the service is busy (429, 503) "
                       "or out of reach (30)"},
              arguments.patience_seconds, 0, 86400);
}

Result<JobClient> JobClient::Open(const ServiceArguments& arguments, std::stop_token stop) {
  Result<ServiceUrl> url = ReadServiceUrl(arguments.url);
  if (!url) return std::move(url.error());
  Result<std::string> key = ReadClientKey(arguments.key_file, *url);
  if (!key) return std::move(key.error());
  return JobClient(*std::move(url), *std::move(key),
                   std::chrono::seconds(arguments.patience_seconds), std::move(stop));
}

Result<ClientResponse> JobClient::Send(ClientRequest request) const {
  if (!key_.empty()) request.headers.emplace_back("Authorization", "Bearer " + key_);
  const Clock::time_point start = Clock::now();
  for (milliseconds pause = kFirstPause;; pause = std::min(2 * pause, kLongestPause)) {
    Result<ClientResponse> response = SendRequest(url_, request, stop_);
    const bool again = response ? response->status == 503 || response->status == 429
                                : response.error().kind == "connection";
    const milliseconds wait = PauseBeforeNext(pause, response);
    if (!again || Clock::now() + wait > start + patience_) return response;
    Pause(wait, stop_);
    if (stop_.stop_requested()) return Error{ErrorCode::kCancelled, "interrupted"};
  }
}

Result<json> JobClient::SendForJson(const std::string& target, int expected,
                                    ClientRequest request) const {
  request.target = target;
  Result<ClientResponse> response = Send(std::move(request));
  if (!response) return std::move(response.error());
  if (response->status != expected) return ErrorOfProblem(*response);
  return JsonOf(*response);
}

std::string TextOf(const json& object, const char* name) {
  constexpr std::size_t kLongest = 2000;
  const auto found = object.find(name);
  if (found == object.end() || !found->is_string()) return {};
  return ShortText(found->get<std::string>(), kLongest);
}

Result<json> JsonOf(const ClientResponse& response) {
  json document = json::parse(response.body, nullptr, false);
  if (document.is_object()) return document;
  return Error{ErrorCode::kIo, "the service's answer is no JSON object; is it a farhorizon?"};
}

Error ErrorOfProblem(const ClientResponse& response) {
  const json problem = json::parse(response.body, nullptr, false);
  std::string detail = "the service answered " + std::to_string(response.status);
  std::string code;
  if (problem.is_object()) {
    code = TextOf(problem, "code");
    const std::string why = TextOf(problem, "detail");
    if (!why.empty()) detail += " " + code + ": " + why;
  }
  if (response.status / 100 == 3) {
    // A key is for the service that was named, so no redirect is followed.
    const std::string where = ShortText(response.Header("location"), 200);
    detail +=
        where.empty() ? "" : ", a redirect to " + where + "; give that service's URL to --url";
  }
  const int status = response.status;
  const bool call =
      (status == 400 && code != "invalid-multipart") || status == 401 || status == 403;
  const bool later = status == 429 || status == 503 || status == 507;
  return {call            ? ErrorCode::kInvalidArgument
          : later         ? ErrorCode::kResourceExhausted
          : status >= 500 ? ErrorCode::kIo
                          : ErrorCode::kUnsupportedData,
          detail, ErrorKind::FromName(code).value_or(ErrorKind())};
}

int ReportClientError(const Error& error) {
  const int status = ReportError(error);
  const bool later = error.code == ErrorCode::kResourceExhausted || error.kind == "connection";
  return later ? kExitTryAgain : status;
}

}  // namespace farhorizon
