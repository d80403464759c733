#include "service/handlers/json.h"

#include <set>
#include <vector>

namespace farhorizon {

namespace {
constexpr int kDeepest = 64;
}  // namespace

Result<nlohmann::json> ParseClientJson(std::string_view text) {
  using nlohmann::json;
  // The library's parser does not recurse, its dump does: refuse depth before anything is built.
  bool too_deep = false;
  bool twice = false;
  std::vector<std::set<std::string>> names;
  const auto watch = [&](int depth, json::parse_event_t event, json& value) {
    if (depth > kDeepest) too_deep = true;
    if (event == json::parse_event_t::object_start) names.emplace_back();
    if (event == json::parse_event_t::object_end && !names.empty()) names.pop_back();
    if (event == json::parse_event_t::key && !names.empty()) {
      twice = !names.back().insert(value.get<std::string>()).second || twice;
    }
    return !too_deep;
  };
  json document = json::parse(text, watch, false);
  const char* fault = document.is_discarded() ? "it cannot be parsed"
                      : too_deep              ? "it is more than 64 deep"
                      : twice                 ? "an object has a name twice"
                                              : nullptr;
  if (too_deep) fault = "it is more than 64 deep";
  if (fault != nullptr) {
    return Error{ErrorCode::kInvalidArgument, std::string("the JSON is at fault: ") + fault,
                 "invalid-json"};
  }
  return document;
}

}  // namespace farhorizon
