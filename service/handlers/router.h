#pragma once

#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "service/handlers/exchange.h"
#include "service/handlers/http_message.h"

namespace farhorizon {

/// What the answer to a request may have to wait for.
enum class WaitsFor {
  kNothing,
  kStore,   ///< disk and database
  kProcess  ///< a worker that looks at an upload
};

/// One method on one path.
struct Route {
  std::string method;
  std::string pattern;  ///< "/jobs/{id}/results/{name}": {…} matches any one segment
      ///< and {…*}, at the end, all that are left, of which there is one at least
  /// Decides from the head. The request outlives the exchange that this returns.
  std::function<Admission(const HttpRequest& request)> begin;
  WaitsFor waits_for = WaitsFor::kStore;
};

/// A route for requests without a body; one that has a body is answered 413 "body-not-allowed".
Route BodylessRoute(std::string method, std::string pattern,
                    std::function<HttpResponse(const HttpRequest& request)> answer,
                    WaitsFor waits_for = WaitsFor::kStore);

/// The answer to OPTIONS for a resource with these methods, also to a browser that asks whether a
/// page of another origin may use them.
HttpResponse OptionsResponse(const std::string& methods);

/// Finds the route of a request. Answers by itself requests that have none: 404, 405, OPTIONS. HEAD
/// takes the route of GET; the server leaves out the body of the response.
/// Threads: safe once built.
class Router {
 public:
  explicit Router(std::vector<Route> routes) : routes_(std::move(routes)) {}

  /// The route of a request of which only the head has been read, nullptr if it has none; sets
  /// request.route and request.parameters, and the method of an upload's request that comes as POST
  /// with X-HTTP-Method-Override.
  const Route* Find(HttpRequest& request) const;

  /// Admits or answers the request. route: as Find gives it. Requires: `request` outlives the
  /// exchange.
  Admission Begin(const Route* route, const HttpRequest& request) const;

  [[nodiscard]] const std::vector<Route>& routes() const { return routes_; }

 private:
  [[nodiscard]] std::vector<std::string> MethodsAt(const std::string& path) const;

  std::vector<Route> routes_;
};

}  // namespace farhorizon
