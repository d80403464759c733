#include "service/handlers/router.h"

#include <algorithm>
#include <exception>
#include <string_view>

#include "service/handlers/problem.h"
#include "service/log.h"

namespace farhorizon {

namespace {

std::vector<std::string_view> Segments(std::string_view path) {
  std::vector<std::string_view> segments;
  for (std::size_t start = 1; start <= path.size();) {
    const std::size_t end = std::min(path.find('/', start), path.size());
    segments.push_back(path.substr(start, end - start));
    start = end + 1;
  }
  return segments;
}

bool IsVariable(std::string_view segment) { return !segment.empty() && segment[0] == '{'; }

/// The values of the pattern's variables; nullopt where `path` is another path.
std::optional<std::vector<std::string>> Match(const std::string& pattern, const std::string& path) {
  const auto wanted = Segments(pattern);
  const auto given = Segments(path);
  if (wanted.size() != given.size()) return std::nullopt;
  std::vector<std::string> values;
  for (std::size_t i = 0; i < wanted.size(); ++i) {
    if (!IsVariable(wanted[i])) {
      if (wanted[i] != given[i]) return std::nullopt;
      continue;
    }
    std::optional<std::string> value = PercentDecode(given[i], false);
    if (!value || value->empty()) return std::nullopt;
    values.push_back(*std::move(value));
  }
  return values;
}

std::string Joined(const std::vector<std::string>& words) {
  std::string text;
  for (const std::string& word : words) text += (text.empty() ? "" : ", ") + word;
  return text;
}

}  // namespace

const Route* Router::Find(const HttpRequest& request, std::vector<std::string>& parameters) const {
  const std::string& method = request.method == "HEAD" ? std::string("GET") : request.method;
  for (const Route& route : routes_) {
    if (route.method != method) continue;
    if (auto values = Match(route.pattern, request.path)) {
      parameters = *std::move(values);
      return &route;
    }
  }
  return nullptr;
}

std::vector<std::string> Router::MethodsAt(const std::string& path) const {
  std::vector<std::string> methods;
  for (const Route& route : routes_) {
    if (!Match(route.pattern, path)) continue;
    methods.push_back(route.method);
    if (route.method == "GET") methods.emplace_back("HEAD");
  }
  if (!methods.empty()) methods.emplace_back("OPTIONS");
  return methods;
}

Admission Router::Begin(HttpRequest& request) const {
  Admission admission;
  if (const Route* route = Find(request, request.parameters)) {
    if (route->admit) return route->admit(request);
    if (request.HasBody()) {
      admission.answer = ProblemResponse(
          request, {413, "body-not-allowed", request.method + " here takes no body; leave it out"});
    }
    return admission;
  }
  const std::vector<std::string> methods = MethodsAt(request.path);
  if (methods.empty() && request.target != "*") {
    admission.answer = ProblemResponse(
        request, {404, "no-such-resource", "there is nothing at this path; see /jobs"});
  } else if (request.method == "OPTIONS") {
    admission.answer.emplace().status = 204;
    admission.answer->Set("Allow", Joined(methods));
    admission.answer->Set("Access-Control-Allow-Methods", Joined(methods));
    admission.answer->Set(
        "Access-Control-Allow-Headers",
        "Content-Type, Idempotency-Key, If-Match, If-None-Match, If-Range, Range");
    admission.answer->Set("Access-Control-Max-Age", "86400");
  } else {
    admission.answer = ProblemResponse(
        request, {405, "method-not-allowed",
                  "this resource does not know that method; it knows " + Joined(methods)});
    admission.answer->Set("Allow", Joined(methods));
  }
  return admission;
}

HttpResponse Router::Finish(const HttpRequest& request, BodySink* sink) const {
  try {
    std::vector<std::string> ignored;
    const Route* route = Find(request, ignored);
    Check(route != nullptr, "a request that was begun has a route");
    // NOLINTNEXTLINE(clang-analyzer-core.CallAndMessage): the analyzer does not know that Check throws
    return route->handle(request, sink);
  } catch (const std::exception& bug) {
    Log(LogLevel::kError, "internal error", {{"path", request.path}, {"error", bug.what()}});
    return ProblemResponse(request,
                           {500, "internal-error", "the service failed inside; its log says why"});
  }
}

}  // namespace farhorizon
