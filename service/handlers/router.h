#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "service/handlers/body_sink.h"
#include "service/handlers/http_message.h"

namespace farhorizon {

/// Answers a request whose body, if it has one, went into `sink`.
using Handler = std::function<HttpResponse(const HttpRequest& request, BodySink* sink)>;
using Admit = std::function<Admission(const HttpRequest& request)>;

/// One method on one path. pattern: "/jobs/{id}/results/{name}"; {…} stands for one segment.
struct Route {
  std::string method;
  std::string pattern;
  Handler handle;
  Admit admit = {};  ///< unset: no body is taken
};

/// Finds the route of a request and answers for those that have none: 404, 405, OPTIONS. HEAD is
/// answered as GET; the server leaves the body out.
/// Threads: safe once built.
class Router {
 public:
  explicit Router(std::vector<Route> routes) : routes_(std::move(routes)) {}

  /// The first step, with the head alone; sets request.parameters.
  Admission Begin(HttpRequest& request) const;
  /// The second, with the body in the sink of the first. Turns exceptions into 500.
  HttpResponse Finish(const HttpRequest& request, BodySink* sink) const;

  [[nodiscard]] const std::vector<Route>& routes() const { return routes_; }

 private:
  [[nodiscard]] const Route* Find(const HttpRequest& request,
                                  std::vector<std::string>& parameters) const;
  [[nodiscard]] std::vector<std::string> MethodsAt(const std::string& path) const;

  std::vector<Route> routes_;
};

}  // namespace farhorizon
