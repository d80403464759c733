#pragma once

#include <stop_token>
#include <string>
#include <utility>

#include <nlohmann/json.hpp>

#include "core/base/result.h"
#include "service/http/client.h"

namespace farhorizon {

/// A client of one service that sends a request again while the service is busy or out of reach.
class JobClient {
 public:
  /// key: sent with each request; empty: none.
  JobClient(ServiceUrl url, std::string key, std::stop_token stop)
      : url_(std::move(url)), key_(std::move(key)), stop_(std::move(stop)) {}

  /// The first answer other than 503 and 429, or the last of six tries.
  /// Errors: as SendRequest; kCancelled where a stop is requested between two tries.
  Result<ClientResponse> Send(ClientRequest request);

  /// The JSON object that answers a request for `target`.
  /// Errors: those of Send; where the status is not `expected`, the problem that the service
  ///   answers; kIo where the answer is no JSON object.
  Result<nlohmann::json> SendForJson(const std::string& target, int expected,
                                     ClientRequest request = {});

 private:
  ServiceUrl url_;
  std::string key_;
  std::stop_token stop_;
};

/// The Error of an answer with a problem document: its status, code and detail.
Error ErrorOfProblem(const ClientResponse& response);

}  // namespace farhorizon
