#include "service/handlers/problem.h"

#include <array>
#include <string_view>

#include <nlohmann/json.hpp>

#include "service/handlers/json.h"

namespace farhorizon {

namespace {

constexpr const char* kOgc = "http://www.opengis.net/def/exceptions/ogcapi-processes-1/1.0/";
constexpr const char* kOurs = "urn:farhorizon:problem:";

struct KindStatus {
  std::string_view kind;
  int status;
};
/// Kinds whose status is not that of their ErrorCode.
constexpr std::array kKindStatuses = {
    KindStatus{"not-a-raster", 415},   KindStatus{"raster-too-large", 413},
    KindStatus{"body-too-large", 413}, KindStatus{"idempotency-key-reused", 422},
    KindStatus{"draining", 503},       KindStatus{"queue-full", 503},
    KindStatus{"no-space", 507},       KindStatus{"memory-limit", 422},
    KindStatus{"timeout", 422},        KindStatus{"file-limit", 422},
    KindStatus{"work-budget", 422},
};

int StatusOf(const Error& error) {
  for (const KindStatus& row : kKindStatuses) {
    if (row.kind == error.kind) return row.status;
  }
  switch (error.code) {
    case ErrorCode::kInvalidArgument:
      return 400;
    case ErrorCode::kNotFound:
      return 404;
    case ErrorCode::kUnsupportedData:
      return error.kind == "worker-crashed" ? 500 : 422;
    case ErrorCode::kResourceExhausted:
    case ErrorCode::kCancelled:
      return 503;
    case ErrorCode::kIo:
      return 500;
  }
  return 500;
}

const char* OgcName(const std::string& code) {
  if (code == "no-such-job") return "no-such-job";
  if (code == "result-not-ready") return "result-not-ready";
  if (code == "result-not-available") return "result-not-available";
  if (code == "invalid-query-parameter-value") return "invalid-query-parameter-value";
  if (code == "no-such-process") return "no-such-process";
  return nullptr;
}

/// Whether the client reads JSON, but neither problems nor everything.
bool WantsPlainJson(const HttpRequest& request) {
  const std::string* accept = request.Header("accept");
  if (accept == nullptr) return false;
  const std::string types = LowerCase(*accept);
  return types.find("application/json") != std::string::npos &&
         types.find("application/problem+json") == std::string::npos &&
         types.find("*/*") == std::string::npos;
}

}  // namespace

Problem ProblemOf(const Error& error) {
  Problem problem{StatusOf(error), error.kind.empty() ? ErrorCodeName(error.code) : error.kind,
                  error.message};
  // A failure of the machine may name what is no client's business; its owner reads it in the log.
  const bool crash = problem.code == "worker-crashed" || problem.code == "result-corrupt";
  if (problem.status == 500 && !crash) {
    problem.detail = "the service failed inside; its log says why";
  }
  return problem;
}

std::string ProblemType(const std::string& code) {
  const char* ogc = OgcName(code);
  return ogc != nullptr ? std::string(kOgc) + ogc : kOurs + code;
}

HttpResponse ProblemResponse(const HttpRequest& request, const Problem& problem) {
  const nlohmann::ordered_json document = {
      {"type", ProblemType(problem.code)}, {"title", ReasonPhrase(problem.status)},
      {"status", problem.status},          {"detail", problem.detail},
      {"instance", request.path},          {"code", problem.code}};
  HttpResponse response;
  response.status = problem.status;
  response.Set("Content-Type",
               WantsPlainJson(request) ? "application/json" : "application/problem+json");
  response.Set("Cache-Control", "no-store");
  if (problem.status == 503 || problem.status == 429) response.Set("Retry-After", "5");
  response.body = DumpJson(document);
  return response;
}

}  // namespace farhorizon
