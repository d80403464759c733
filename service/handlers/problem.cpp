#include "service/handlers/problem.h"

#include <algorithm>
#include <array>
#include <span>
#include <string_view>
#include <utility>

#include <nlohmann/json.hpp>

#include "service/handlers/json.h"
#include "service/handlers/parameter_names.h"

namespace farhorizon {

namespace {

constexpr const char* kOgc = "http://www.opengis.net/def/exceptions/ogcapi-processes-1/1.0/";
constexpr const char* kOurs = "urn:farhorizon:problem:";

constexpr ErrorKind kKinds400[] = {
    "bad-azimuth",
    "bad-request",
    "digest-mismatch",
    "invalid-address",
    "invalid-argument",
    "invalid-config",
    "invalid-idempotency-key",
    "invalid-json",
    "invalid-multipart",
    "invalid-parameter",
    "invalid-query-parameter-value",
    "invalid-upload",
    "invalid-url",
    "max-error-too-small",
    "mesh-frame",
    "no-such-level",
    "unknown-config",
    "unknown-format",
    "unknown-parameter",
    "virtual-path",
};
constexpr ErrorKind kKinds401[] = {"invalid-key", "key-required"};
constexpr ErrorKind kKinds403[] = {"callback-not-allowed", "href-not-allowed", "insufficient-scope",
                                   "origin-not-allowed"};
constexpr ErrorKind kKinds404[] = {
    "no-config",      "no-such-file",         "no-such-job",      "no-such-key",
    "no-such-output", "no-such-process",      "no-such-resource", "no-such-upload",
    "not-found",      "result-not-available", "result-not-ready",
};
constexpr ErrorKind kKinds405[] = {"method-not-allowed"};
constexpr ErrorKind kKinds408[] = {"request-timeout"};
constexpr ErrorKind kKinds409[] = {"upload-incomplete", "upload-offset-mismatch"};
constexpr ErrorKind kKinds412[] = {"precondition-failed", "unsupported-tus-version"};
constexpr ErrorKind kKinds413[] = {"body-not-allowed", "body-too-large", "raster-too-large"};
constexpr ErrorKind kKinds414[] = {"target-too-long"};
constexpr ErrorKind kKinds415[] = {
    "not-a-raster",
    "unsupported-media-type",
};
constexpr ErrorKind kKinds416[] = {"range-not-satisfiable"};
constexpr ErrorKind kKinds417[] = {"expectation-failed"};
constexpr ErrorKind kKinds421[] = {"misdirected-request"};
constexpr ErrorKind kKinds422[] = {
    "all-nodata",
    "bad-draco",
    "bad-geojson",
    "bad-glb",
    "bad-manifest",
    "bad-mesh",
    "bad-mesh-file",
    "bad-report",
    "bad-tileset",
    "block-too-large",
    "cells-too-narrow",
    "degenerate-geotransform",
    "displaced-vertex",
    "file-limit",
    "flipped-triangle",
    "height-out-of-range",
    "hole",
    "idempotency-key-reused",
    "infinite-height",
    "kinetic-too-large",
    "local-crs",
    "memory-limit",
    "mesh-elsewhere",
    "mesh-too-large",
    "no-crs",
    "no-geoid-grid",
    "no-surface",
    "outside-crs",
    "overlap",
    "rotated-geotransform",
    "several-bands",
    "timeout",
    "too-large-extent",
    "too-small",
    "truncated",
    "unknown-crs",
    "unknown-point",
    "unknown-post",
    "unknown-unit",
    "unnamed-points",
    "unsupported-data",
    "unsupported-type",
    "work-budget",
};
constexpr ErrorKind kKinds429[] = {"too-many-jobs", "too-many-requests", "too-many-uploads"};
constexpr ErrorKind kKinds431[] = {
    "head-too-large",
    "too-many-header-fields",
};
// Of tus, which has it for want of one in HTTP.
constexpr ErrorKind kKinds460[] = {"checksum-mismatch"};
constexpr ErrorKind kKinds500[] = {
    "cannot-listen",  "connection",         "data-directory",
    "input-corrupt",  "internal-error",     "io",
    "job-store",      "job-store-unusable", "poison-job",
    "reference-data", "result-corrupt",     "sandbox-missing",
    "worker-crashed", "worker-program",     "worker-stuck",
};
constexpr ErrorKind kKinds501[] = {"transfer-encoding-not-implemented"};
constexpr ErrorKind kKinds502[] = {"href-failed"};
constexpr ErrorKind kKinds503[] = {
    "cancelled",    "draining",
    "queue-full",   "resource-exhausted",
    "storage",      "too-many-connections",
    "uploads-full", "worker-not-started",
};
constexpr ErrorKind kKinds504[] = {"href-timeout"};
constexpr ErrorKind kKinds505[] = {"version-not-supported"};
constexpr ErrorKind kKinds507[] = {"no-space"};

struct StatusRow {
  int status;
  std::span<const ErrorKind> kinds;
};
constexpr std::array kStatuses = {
    StatusRow{400, kKinds400}, StatusRow{401, kKinds401}, StatusRow{403, kKinds403},
    StatusRow{404, kKinds404}, StatusRow{405, kKinds405}, StatusRow{408, kKinds408},
    StatusRow{409, kKinds409}, StatusRow{412, kKinds412}, StatusRow{413, kKinds413},
    StatusRow{414, kKinds414}, StatusRow{415, kKinds415}, StatusRow{416, kKinds416},
    StatusRow{417, kKinds417}, StatusRow{421, kKinds421}, StatusRow{422, kKinds422},
    StatusRow{429, kKinds429}, StatusRow{431, kKinds431}, StatusRow{460, kKinds460},
    StatusRow{500, kKinds500}, StatusRow{501, kKinds501}, StatusRow{502, kKinds502},
    StatusRow{503, kKinds503}, StatusRow{504, kKinds504}, StatusRow{505, kKinds505},
    StatusRow{507, kKinds507},
};

// 0 if the kind is in no row, or in several.
constexpr int StatusInRows(ErrorKind kind) {
  int found = 0;
  for (const StatusRow& row : kStatuses) {
    for (const ErrorKind listed : row.kinds) {
      if (listed != kind) continue;
      if (found != 0) return 0;
      found = row.status;
    }
  }
  return found;
}

static_assert(std::all_of(kErrorKinds.begin(), kErrorKinds.end(),
                          [](std::string_view name) {
                            return StatusInRows(*ErrorKind::FromName(name)) != 0;
                          }),
              "each of kErrorKinds has exactly one status");

// Whether OGC API - Processes has a URI of its own for `code`.
bool IsOgcName(ErrorKind code) {
  constexpr ErrorKind kNames[] = {"invalid-query-parameter-value", "no-such-job", "no-such-process",
                                  "result-not-available", "result-not-ready"};
  return std::find(std::begin(kNames), std::end(kNames), code) != std::end(kNames);
}

// Whether the client reads JSON, but neither problems nor everything.
bool WantsPlainJson(const HttpRequest& request) {
  const std::string* accept = request.Header("accept");
  if (accept == nullptr) return false;
  const std::string types = LowerCase(*accept);
  return types.find("application/json") != std::string::npos &&
         types.find("application/problem+json") == std::string::npos &&
         types.find("*/*") == std::string::npos;
}

}  // namespace

Problem::Problem(ErrorKind kind, std::string text)
    : status(HttpStatusOf(kind)), code(kind), detail(std::move(text)) {}

Error InvalidParameter(const std::string& what) {
  return {ErrorCode::kInvalidArgument, what, "invalid-parameter"};
}

int HttpStatusOf(ErrorKind kind) {
  Check(!kind.empty(), "a problem has a code");
  return StatusInRows(kind);
}

Problem ProblemOf(const Error& error) {
  const ErrorKind code =
      error.kind.empty() ? ErrorKind::FromName(ErrorCodeName(error.code)).value() : error.kind;
  Problem problem(code, WithParameterNames(error.message));
  // The message of such a failure may name paths of this machine: it belongs in the log alone.
  constexpr ErrorKind kTold[] = {"input-corrupt", "poison-job", "result-corrupt", "worker-crashed",
                                 "worker-stuck"};
  const bool told = std::find(std::begin(kTold), std::end(kTold), code) != std::end(kTold);
  if (problem.status == 500 && !told) {
    problem.detail = "the service failed inside; its log says why";
  }
  if (code == "storage") {
    problem.detail =
        "uploads and results cannot be stored or read at the moment; its log says why; try again";
  }
  return problem;
}

std::string ProblemType(ErrorKind code) {
  return (IsOgcName(code) ? kOgc : kOurs) + std::string(code);
}

HttpResponse ProblemResponse(const HttpRequest& request, const Problem& problem) {
  const nlohmann::ordered_json document = {
      {"type", ProblemType(problem.code)}, {"title", ReasonPhrase(problem.status)},
      {"status", problem.status},          {"detail", problem.detail},
      {"instance", request.path},          {"code", problem.code.name()}};
  HttpResponse response;
  response.status = problem.status;
  response.code = problem.code.name();
  response.Set("Content-Type",
               WantsPlainJson(request) ? "application/json" : "application/problem+json");
  response.Set("Cache-Control", "no-store");
  if (problem.status == 503 || problem.status == 429) response.Set("Retry-After", "5");
  response.body = DumpJson(document);
  return response;
}

}  // namespace farhorizon
