#pragma once

#include <memory>
#include <string_view>
#include <variant>

#include "core/base/result.h"
#include "service/handlers/http_message.h"

namespace farhorizon {

/// A request that its route has admitted, on the way to its response: takes the body's pieces as
/// they arrive, then finishes. An exchange is for one request.
class Exchange {
 public:
  Exchange() = default;
  virtual ~Exchange() = default;
  Exchange(const Exchange&) = delete;
  Exchange& operator=(const Exchange&) = delete;

  /// Takes the next piece of the body. After an error the request is answered with it and its
  /// connection closed.
  virtual Status Take(std::string_view piece) = 0;

  /// The request ends without Finish: its body was broken off or too slow, or Take has failed. The
  /// last call.
  virtual void Abandon() {}

  /// The response. Requires: the whole body has been taken; called once.
  virtual HttpResponse Finish() = 0;
};

/// What a route decides from a request's head, before the client is asked for the body: a response
/// at once, or an exchange.
using Admission = std::variant<HttpResponse, std::unique_ptr<Exchange>>;

/// exchange.Finish(), with an exception turned into 500 "internal-error" and a line of the log.
HttpResponse FinishExchange(Exchange& exchange, const HttpRequest& request);

/// exchange.Abandon(), with an exception turned into a line of the log.
void AbandonExchange(Exchange& exchange, const HttpRequest& request);

}  // namespace farhorizon
