#pragma once

#include <chrono>
#include <stop_token>
#include <string>
#include <utility>

#include <nlohmann/json.hpp>

#include "core/base/result.h"
#include "service/cli/command_line.h"
#include "service/http/client.h"

namespace farhorizon {

/// The exit status where a service is busy or out of reach, or a job has not ended: the same call
/// may succeed later.
constexpr int kExitTryAgain = 75;

/// Which service a command speaks to, and how.
struct ServiceArguments {
  std::string url;
  std::string key_file;
  int patience_seconds = 30;
};
/// Adds --url, --key-file and --patience. Requires: `arguments` outlives the parse.
void AddServiceOptions(Command& command, ServiceArguments& arguments);

/// A client of one service that sends a request again while the service is busy or out of reach.
/// Threads: safe.
class JobClient {
 public:
  /// Errors: kInvalidArgument, kNotFound where the URL or the key cannot be read.
  static Result<JobClient> Open(const ServiceArguments& arguments, std::stop_token stop);

  /// The first answer other than 503 and 429, or the last one within the patience. Waits longer
  /// from try to try, as long as Retry-After says at least.
  /// Errors: as SendRequest; kCancelled where a stop is requested between two tries.
  Result<ClientResponse> Send(ClientRequest request) const;

  /// The JSON object that answers a request for `target`.
  /// Errors: those of Send; where the status is not `expected`, the problem that the service
  ///   answers; kIo where the answer is no JSON object.
  Result<nlohmann::json> SendForJson(const std::string& target, int expected,
                                     ClientRequest request = {}) const;

  [[nodiscard]] const std::stop_token& stop() const { return stop_; }

 private:
  JobClient(ServiceUrl url, std::string key, std::chrono::seconds patience, std::stop_token stop)
      : url_(std::move(url)), key_(std::move(key)), patience_(patience), stop_(std::move(stop)) {}

  ServiceUrl url_;
  std::string key_;
  std::chrono::seconds patience_;
  std::stop_token stop_;
};

/// The member `name` of what a service says; empty where it is no text. No terminal obeys it: it
/// has blanks for control characters, and no more than two thousand bytes.
std::string TextOf(const nlohmann::json& object, const char* name);

/// The JSON object in an answer. Errors: kIo where there is none.
Result<nlohmann::json> JsonOf(const ClientResponse& response);

/// The Error of an answer with a problem document: its status, code and detail. Of 429, 503 and
/// 507 it is kResourceExhausted.
Error ErrorOfProblem(const ClientResponse& response);

/// Prints `error`; the exit status for it, kExitTryAgain among them.
int ReportClientError(const Error& error);

}  // namespace farhorizon
