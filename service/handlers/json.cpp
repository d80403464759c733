#include "service/handlers/json.h"

#include "core/io/sha256.h"
#include "service/handlers/byte_range.h"
#include "service/handlers/problem.h"

namespace farhorizon {

std::string DumpJson(const nlohmann::ordered_json& document) {
  return document.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace) + "\n";
}

HttpResponse JsonResponse(const nlohmann::ordered_json& document) {
  HttpResponse response;
  response.Set("Content-Type", "application/json");
  response.Set("Cache-Control", "no-store");
  response.body = DumpJson(document);
  return response;
}

HttpResponse TaggedJsonResponse(const HttpRequest& request,
                                const nlohmann::ordered_json& document) {
  HttpResponse response = JsonResponse(document);
  const std::string etag = "\"" + Sha256Hex(response.body) + "\"";
  HttpRequest whole = request;  // a range of a status helps nobody
  std::erase_if(whole.headers, [](const auto& field) { return field.first == "range"; });
  const int status =
      SelectBytes(whole, etag, static_cast<std::int64_t>(response.body.size())).status;
  if (status == 412) {
    return ProblemResponse(request,
                           {"precondition-failed", "it is not the one that If-Match names"});
  }
  response.headers = {
      {"Content-Type", "application/json"}, {"Cache-Control", "no-cache"}, {"ETag", etag}};
  response.status = status;
  if (status == 304) response.body.clear();
  return response;
}

}  // namespace farhorizon
