#include "service/handlers/router.h"

#include <algorithm>
#include <memory>
#include <optional>
#include <string_view>

#include "service/handlers/problem.h"
#include "service/url_query.h"

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

bool IsTail(std::string_view segment) { return IsVariable(segment) && segment.ends_with("*}"); }

// The values of the pattern's variables; nullopt if `path` does not match.
std::optional<std::vector<std::string>> Match(const std::string& pattern, const std::string& path) {
  const auto wanted = Segments(pattern);
  const auto given = Segments(path);
  const bool open = IsTail(wanted.back());
  if (open ? wanted.size() > given.size() : wanted.size() != given.size()) return std::nullopt;
  std::vector<std::string> values;
  for (std::size_t i = 0; i < wanted.size(); ++i) {
    if (!IsVariable(wanted[i])) {
      if (wanted[i] != given[i]) return std::nullopt;
      continue;
    }
    std::optional<std::string> value = PercentDecode(given[i]);
    if (!value || value->empty()) return std::nullopt;
    values.push_back(*std::move(value));
  }
  for (std::size_t i = wanted.size(); i < given.size(); ++i) {
    const std::optional<std::string> value = PercentDecode(given[i]);
    if (!value) return std::nullopt;
    values.back() += "/" + *value;
  }
  return values;
}

std::string Joined(const std::vector<std::string>& words) {
  std::string text;
  for (const std::string& word : words) text += (text.empty() ? "" : ", ") + word;
  return text;
}

// An exchange whose response depends on the head alone.
class BodylessExchange : public Exchange {
 public:
  BodylessExchange(const HttpRequest& request,
                   const std::function<HttpResponse(const HttpRequest&)>& answer)
      : request_(request), answer_(answer) {}

  Status Take(std::string_view) override {
    Check(false, "a request with a body is not admitted here");
    return Ok{};
  }
  HttpResponse Finish() override { return answer_(request_); }

 private:
  const HttpRequest& request_;
  const std::function<HttpResponse(const HttpRequest&)>& answer_;
};

// For clients that know no PATCH and DELETE [Tus, "X-HTTP-Method-Override"].
void TakeMethodOverride(HttpRequest& request) {
  if (request.method != "POST" || !request.path.starts_with("/uploads/")) return;
  const std::string* method = request.Header("x-http-method-override");
  if (method != nullptr && (*method == "PATCH" || *method == "DELETE" || *method == "HEAD")) {
    request.method = *method;
  }
}

}  // namespace

HttpResponse OptionsResponse(const std::string& methods) {
  HttpResponse response;
  response.status = 204;
  response.Set("Allow", methods);
  response.Set("Access-Control-Allow-Methods", methods);
  response.Set(
      "Access-Control-Allow-Headers",
      "Authorization, Content-Digest, Content-Type, Idempotency-Key, If-Match, "
      "If-None-Match, If-Range, Prefer, Range, traceparent, Tus-Resumable, Upload-Checksum, "
      "Upload-Defer-Length, Upload-Length, Upload-Metadata, Upload-Offset, "
      "X-HTTP-Method-Override, X-Request-Id");
  response.Set("Access-Control-Max-Age", "86400");
  return response;
}

Route BodylessRoute(std::string method, std::string pattern,
                    std::function<HttpResponse(const HttpRequest& request)> answer,
                    WaitsFor waits_for) {
  const auto begin = [answer = std::move(answer)](const HttpRequest& request) -> Admission {
    if (request.HasBody()) {
      return ProblemResponse(
          request, {"body-not-allowed", request.method + " here takes no body; leave it out"});
    }
    return std::make_unique<BodylessExchange>(request, answer);
  };
  return {std::move(method), std::move(pattern), begin, waits_for};
}

const Route* Router::Find(HttpRequest& request) const {
  TakeMethodOverride(request);
  const std::string& method = request.method == "HEAD" ? std::string("GET") : request.method;
  for (const Route& route : routes_) {
    if (route.method != method) continue;
    if (auto values = Match(route.pattern, request.path)) {
      request.route = route.pattern;
      request.parameters = *std::move(values);
      return &route;
    }
  }
  return nullptr;
}

std::vector<std::string> Router::MethodsAt(const std::string& path) const {
  std::vector<std::string> methods;
  for (const Route& route : routes_) {
    if (route.method == "OPTIONS" || !Match(route.pattern, path)) continue;
    methods.push_back(route.method);
    if (route.method == "GET") methods.emplace_back("HEAD");
  }
  if (!methods.empty()) methods.emplace_back("OPTIONS");
  return methods;
}

Admission Router::Begin(const Route* route, const HttpRequest& request) const {
  if (route != nullptr) return route->begin(request);
  const std::vector<std::string> methods = MethodsAt(request.path);
  if (methods.empty() && request.target != "*") {
    return ProblemResponse(request,
                           {"no-such-resource", "there is nothing at this path; see /jobs"});
  }
  if (request.method == "OPTIONS") return OptionsResponse(Joined(methods));
  HttpResponse response = ProblemResponse(
      request, {"method-not-allowed",
                "this resource does not know that method; it knows " + Joined(methods)});
  response.Set("Allow", Joined(methods));
  return response;
}

}  // namespace farhorizon
