#include "service/cli/job_client.h"

#include <algorithm>
#include <chrono>

#include "service/clock.h"

namespace farhorizon {

namespace {

using nlohmann::json;
using std::chrono::milliseconds;

constexpr int kTries = 6;
constexpr milliseconds kFirstPause{100};
constexpr milliseconds kLongestPause{2000};

}  // namespace

Result<ClientResponse> JobClient::Send(ClientRequest request) {
  if (!key_.empty()) request.headers.emplace_back("Authorization", "Bearer " + key_);
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

Result<json> JobClient::SendForJson(const std::string& target, int expected,
                                    ClientRequest request) {
  request.target = target;
  Result<ClientResponse> response = Send(std::move(request));
  if (!response) return std::move(response.error());
  if (response->status != expected) return ErrorOfProblem(*response);
  json document = json::parse(response->body, nullptr, false);
  if (document.is_object()) return document;
  return Error{ErrorCode::kIo, "the service's answer is no JSON object; is it a farhorizon?"};
}

Error ErrorOfProblem(const ClientResponse& response) {
  const json problem = json::parse(response.body, nullptr, false);
  std::string detail = "the service answered " + std::to_string(response.status);
  std::string code;
  if (problem.is_object()) {
    if (problem.contains("code") && problem["code"].is_string()) code = problem["code"];
    if (problem.contains("detail") && problem["detail"].is_string()) {
      detail += " " + code + ": " + problem["detail"].get<std::string>();
    }
  }
  const bool call = (response.status == 400 && code != "invalid-multipart") ||
                    response.status == 401 || response.status == 403;
  return {call                     ? ErrorCode::kInvalidArgument
          : response.status >= 500 ? ErrorCode::kIo
                                   : ErrorCode::kUnsupportedData,
          detail, ErrorKind::FromName(code).value_or(ErrorKind())};
}

}  // namespace farhorizon
