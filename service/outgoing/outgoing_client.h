#pragma once

#include <chrono>
#include <cstdint>
#include <functional>
#include <stop_token>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/result.h"
#include "service/outgoing/address_rules.h"
#include "service/outgoing/outgoing_url.h"

namespace farhorizon {

/// A request of this service to a server that a client has named.
struct OutgoingRequest {
  OutgoingUrl url;
  std::vector<std::string> headers = {};  ///< "Name: value"
  std::string body = {};                  ///< POST where `is_post`, else GET without a body
  bool is_post = false;
  std::chrono::milliseconds connect_time{5000};
  std::chrono::milliseconds time{30'000};  ///< of all, from the look-up of the name on
  /// Takes the body of a 200, piece by piece; what it returns ends the transfer. nullptr: the body
  /// is not wanted.
  std::function<Status(std::string_view)> take = {};
  std::int64_t most_bytes = 0;  ///< of that body
  /// Names with their addresses, in place of a look-up: "name:port:address,address". For tests.
  std::vector<std::string> resolve = {};
};

/// What came of it.
struct OutgoingResponse {
  int status = 0;
  std::string location;  ///< of a redirect, which is never followed
  std::string address;   ///< that was connected to
  std::int64_t bytes = 0;
};

/// At most 200 characters of what another server has sent, for a message: what is not printable in
/// ASCII is a question mark.
std::string Printable(std::string_view text);

/// Sends one request on a connection of its own, by HTTP/1.1, and TLS that is verified for https.
/// The socket is made for an address that `rules` allow, the very one that is connected to: what
/// the name meant before or means later does not matter. Of several addresses those that are not
/// allowed are passed over. Redirects, proxies and content codings are not followed, used or taken;
/// nothing is sent but what the request has. Blocks for `time` at most, little longer after a stop.
///
/// Errors: kInvalidArgument "href-not-allowed" where no address is allowed; kResourceExhausted
///   "href-timeout"; kResourceExhausted "body-too-large"; kIo "href-failed", with the cause;
///   kCancelled; those of `take`.
/// Threads: safe.
Result<OutgoingResponse> SendOutgoing(const OutgoingRequest& request, const AddressRules& rules,
                                      const std::stop_token& stop = {});

}  // namespace farhorizon
