#pragma once

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <limits>
#include <map>
#include <optional>
#include <stop_token>
#include <string>
#include <utility>
#include <vector>

#include "core/base/result.h"

namespace farhorizon {

/// The parts of "http://HOST[:PORT][/PREFIX]".
struct ServiceUrl {
  std::string host;
  std::uint16_t port = 80;
  std::string prefix;  ///< without a slash at its end
};
/// Errors: kInvalidArgument "invalid-url".
Result<ServiceUrl> ReadServiceUrl(const std::string& text);

struct ClientRequest {
  std::string method = "GET";
  std::string target;  ///< after the prefix: "/jobs"
  std::vector<std::pair<std::string, std::string>> headers = {};
  std::optional<std::filesystem::path> upload = {};    ///< the body
  std::optional<std::filesystem::path> download = {};  ///< file for the body of a 200
  /// How many bytes the file may have in the end; the answer is given up where it has more.
  std::uintmax_t most_bytes = std::numeric_limits<std::uintmax_t>::max();
  /// The entity tag of what is downloaded, with its quotes: what the file has of it already is not
  /// asked for again, and the rest is added to it. Empty: the file is written anew.
  std::string resumes = {};
  std::function<void(double)> uploaded = {};  ///< called with the share that has been sent
};

struct ClientResponse {
  int status = 0;
  std::map<std::string, std::string> headers;  ///< the last of each name, in lower case
  std::string body;  ///< at most 64 MiB; empty if it went to ClientRequest::download

  /// The field of that name, in lower case; empty where there is none.
  [[nodiscard]] std::string Header(const std::string& name) const {
    const auto found = headers.find(name);
    return found == headers.end() ? "" : found->second;
  }
};

/// Sends one request on a connection of its own. Every wait has a deadline.
/// Errors: kIo "connection" if no service answers or the connection breaks (trying again may help);
///   kCancelled.
Result<ClientResponse> SendRequest(const ServiceUrl& url, const ClientRequest& request,
                                   const std::stop_token& stop = {});

}  // namespace farhorizon
