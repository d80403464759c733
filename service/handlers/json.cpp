#include "service/handlers/json.h"

#include "core/io/sha256.h"
#include "service/handlers/byte_range.h"
#include "service/handlers/problem.h"

namespace farhorizon {

std::string DumpJson(const nlohmann::ordered_json& document) {
  return document.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace) + "\n";
}

std::string TagOf(const std::string& text) { return "\"" + Sha256Hex(text) + "\""; }

HttpResponse JsonResponse(const nlohmann::ordered_json& document) {
  HttpResponse response;
  response.Set("Content-Type", "application/json");
  response.Set("Cache-Control", "no-store");
  response.body = DumpJson(document);
  return response;
}

HttpResponse TaggedJsonResponse(const HttpRequest& request, const nlohmann::ordered_json& document,
                                const char* type) {
  HttpResponse response;
  response.body = DumpJson(document);
  const std::string etag = TagOf(response.body);
  response.status = StatusByConditions(request, etag);
  if (response.status == 412) {
    return ProblemResponse(request,
                           {"precondition-failed", "it is not the one that If-Match names"});
  }
  response.Set("Content-Type", type);
  response.Set("Cache-Control", "no-cache");
  response.Set("ETag", etag);
  if (response.status == 304) response.body.clear();
  return response;
}

}  // namespace farhorizon
