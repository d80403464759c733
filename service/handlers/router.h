#pragma once

#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "service/handlers/exchange.h"
#include "service/handlers/http_message.h"

namespace farhorizon {

/// One method on one path.
struct Route {
  std::string method;
  std::string pattern;  ///< "/jobs/{id}/results/{name}": {…} matches any one segment
  /// Decides from the head. The request outlives the exchange that this returns.
  std::function<Admission(const HttpRequest& request)> begin;
};

/// A route for requests without a body; one that has a body is answered 413 "body-not-allowed".
Route BodylessRoute(std::string method, std::string pattern,
                    std::function<HttpResponse(const HttpRequest& request)> answer);

/// Finds the route of a request. Answers by itself requests that have none: 404, 405, OPTIONS. HEAD
/// takes the route of GET; the server leaves out the body of the response.
/// Threads: safe once built.
class Router {
 public:
  explicit Router(std::vector<Route> routes) : routes_(std::move(routes)) {}

  /// Admits or answers a request of which only the head has been read, and sets
  /// request.parameters. Requires: `request` outlives the exchange.
  Admission Begin(HttpRequest& request) const;

  [[nodiscard]] const std::vector<Route>& routes() const { return routes_; }

 private:
  [[nodiscard]] const Route* Find(HttpRequest& request) const;
  [[nodiscard]] std::vector<std::string> MethodsAt(const std::string& path) const;

  std::vector<Route> routes_;
};

}  // namespace farhorizon
