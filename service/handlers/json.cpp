#include "service/handlers/json.h"

#include <set>
#include <vector>

namespace farhorizon {

namespace {

constexpr int kMaxDepth = 64;

}  // namespace

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

Result<nlohmann::json> ParseClientJson(std::string_view text) {
  using nlohmann::json;
  // nlohmann's parser does not recurse, but its dump and its destructor do: deep text is refused
  // before a document is built of it.
  bool too_deep = false;
  bool twice = false;
  std::vector<std::set<std::string>> names;
  const auto visit = [&](int depth, json::parse_event_t event, json& value) {
    if (depth > kMaxDepth) too_deep = true;
    if (event == json::parse_event_t::object_start) names.emplace_back();
    if (event == json::parse_event_t::object_end && !names.empty()) names.pop_back();
    if (event == json::parse_event_t::key && !names.empty()) {
      twice = !names.back().insert(value.get<std::string>()).second || twice;
    }
    return !too_deep;
  };
  json document = json::parse(text, visit, false);
  const char* fault = too_deep                  ? "it is more than 64 deep"
                      : document.is_discarded() ? "it cannot be parsed"
                      : twice                   ? "an object has a name twice"
                                                : nullptr;
  if (fault != nullptr) {
    return Error{ErrorCode::kInvalidArgument, std::string("the JSON is at fault: ") + fault,
                 "invalid-json"};
  }
  return document;
}

}  // namespace farhorizon
