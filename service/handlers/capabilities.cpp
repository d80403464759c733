#include "service/handlers/capabilities.h"

#include <algorithm>
#include <optional>
#include <string>
#include <utility>

#include "core/pipeline/option_numbers.h"
#include "service/handlers/api_document.h"
#include "service/handlers/execute_request.h"
#include "service/handlers/json.h"
#include "service/handlers/problem.h"
#include "service/handlers/processes.h"

namespace farhorizon {

namespace {

using nlohmann::ordered_json;

constexpr const char* kJson = "application/json";
constexpr const char* kOpenApi30 = "application/vnd.oai.openapi+json;version=3.0";
constexpr const char* kOpenApi31 = "application/vnd.oai.openapi+json;version=3.1";
constexpr const char* kRelations = "http://www.opengis.net/def/rel/ogc/1.0/";
constexpr std::int64_t kMostProcesses = 10000;
constexpr std::int64_t kUsualProcesses = 10;

// The classes of requirements that are kept.
constexpr const char* kConformsTo[] = {
    "http://www.opengis.net/spec/ogcapi-processes-1/1.0/conf/core",
    "http://www.opengis.net/spec/ogcapi-processes-1/1.0/conf/ogc-process-description",
    "http://www.opengis.net/spec/ogcapi-processes-1/1.0/conf/json",
    "http://www.opengis.net/spec/ogcapi-processes-1/1.0/conf/oas30",
    "http://www.opengis.net/spec/ogcapi-processes-1/1.0/conf/job-list",
    "http://www.opengis.net/spec/ogcapi-processes-1/1.0/conf/dismiss",
    "http://www.opengis.net/spec/ogcapi-common-1/1.0/conf/core"};

HttpResponse BadQuery(const HttpRequest& request, const std::string& what) {
  return ProblemResponse(request, {"invalid-query-parameter-value", what});
}

// The class of those that are kept where somebody may be called.
constexpr const char* kCallback =
    "http://www.opengis.net/spec/ogcapi-processes-1/1.0/conf/callback";

HttpResponse ShowConformance(const HandlerContext& context, const HttpRequest& request) {
  ordered_json classes = ordered_json::array();
  for (const char* kept : kConformsTo) classes.push_back(kept);
  if (context.callbacks) classes.push_back(kCallback);
  return TaggedJsonResponse(request, {{"conformsTo", std::move(classes)}});
}

// 3.1 says the most; 3.0 is for the clients of OGC's standards, which know no other.
HttpResponse ShowApi(const HandlerContext& context, const HttpRequest& request) {
  const std::optional<Parameters> query = DecodeQuery(request.query);
  const Parameters asked = query.value_or(Parameters{{"", ""}});
  const auto version = asked.find("v");
  const bool known = asked.empty() || (asked.size() == 1 && version != asked.end() &&
                                       (version->second == "3.0" || version->second == "3.1"));
  if (!known) return BadQuery(request, "the one parameter here is v, which is 3.0 or 3.1");
  const bool is30 = !asked.empty() && version->second == "3.0";
  const OpenApiVersion wanted = is30 ? OpenApiVersion::k30 : OpenApiVersion::k31;
  return TaggedJsonResponse(request, ApiDocument(wanted, context.base),
                            is30 ? kOpenApi30 : kOpenApi31);
}

// How many processes the list is to have; nullopt for a query that cannot be used.
std::optional<std::size_t> LimitOf(const HttpRequest& request) {
  const std::optional<Parameters> query = DecodeQuery(request.query);
  if (!query) return std::nullopt;
  std::int64_t limit = kUsualProcesses;
  for (const auto& [name, value] : *query) {
    const std::optional<std::int64_t> number = WholeNumberIn(value);
    if (name != "limit" || !number || *number < 1 || *number > kMostProcesses) return std::nullopt;
    limit = *number;
  }
  return static_cast<std::size_t>(limit);
}

HttpResponse ListProcesses(const HandlerContext& context, const HttpRequest& request) {
  const std::optional<std::size_t> limit = LimitOf(request);
  if (!limit) {
    return BadQuery(request,
                    "the one parameter here is limit, which is a whole number from 1 to 10000");
  }
  ordered_json processes = ordered_json::array();
  for (const std::string& name : ProcessNames(context)) {
    if (processes.size() < *limit) processes.push_back(ProcessSummary(name, context.base));
  }
  return TaggedJsonResponse(
      request, {{"processes", processes},
                {"links",
                 {{{"rel", "self"}, {"type", kJson}, {"href", context.base + "/processes"}},
                  {{"rel", "up"}, {"type", kJson}, {"href", context.base + "/"}}}}});
}

HttpResponse ShowProcess(const HandlerContext& context, const HttpRequest& request) {
  const std::string& name = request.parameters.at(0);
  if (!IsOffered(context, name)) return ProblemResponse(request, ProblemOf(NoSuchProcess(name)));
  return TaggedJsonResponse(request, ProcessDescription(name, context.base));
}

}  // namespace

ordered_json LandingDocument(const std::string& base) {
  const auto link = [&](const std::string& relation, const char* type, const char* path,
                        const char* title) {
    return ordered_json{{"rel", relation}, {"type", type}, {"title", title}, {"href", base + path}};
  };
  const std::string relations = kRelations;
  return {{"title", "farhorizon"},
          {"description",
           "Turns elevation grids into levels of detail whose skyline is exactly that of the "
           "original"},
          {"links",
           {link("self", kJson, "/", "This document"),
            link("alternate", "text/html", "/", "The same for people"),
            link(relations + "job-list", kJson, "/jobs", "The jobs; POST sends a DEM"),
            link(relations + "processes", kJson, "/processes", "What jobs can be of"),
            link(relations + "conformance", kJson, "/conformance", "The standards that are kept"),
            link("conformance", kJson, "/conformance", "The standards that are kept"),
            link("service-desc", kOpenApi30, "/api?v=3.0", "This API in OpenAPI 3.0"),
            link("service-desc", kOpenApi31, "/api", "This API in OpenAPI 3.1")}}};
}

std::vector<Route> CapabilityRoutes(const HandlerContext& context) {
  constexpr WaitsFor kNothing = WaitsFor::kNothing;
  return {
      BodylessRoute(
          "GET", "/conformance",
          [context](const HttpRequest& request) { return ShowConformance(context, request); },
          kNothing),
      BodylessRoute(
          "GET", "/api",
          [context](const HttpRequest& request) { return ShowApi(context, request); }, kNothing),
      BodylessRoute(
          "GET", "/processes",
          [context](const HttpRequest& request) { return ListProcesses(context, request); },
          kNothing),
      BodylessRoute(
          "GET", "/processes/{id}",
          [context](const HttpRequest& request) { return ShowProcess(context, request); },
          kNothing)};
}

}  // namespace farhorizon
