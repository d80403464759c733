#include "service/strict_json.h"

#include <set>
#include <string>
#include <vector>

namespace farhorizon {

namespace {

constexpr int kMaxDepth = 64;

}  // namespace

Result<nlohmann::json> ParseStrictJson(std::string_view text) {
  using nlohmann::json;
  // nlohmann's parser does not recurse, but its dump and its destructor do: deep text is refused
  // before a document is built of it.
  bool too_deep = false;
  bool twice = false;
  bool nul = false;
  std::vector<std::set<std::string>> names;
  const auto visit = [&](int depth, json::parse_event_t event, json& value) {
    if (depth > kMaxDepth) too_deep = true;
    if (event == json::parse_event_t::object_start) names.emplace_back();
    if (event == json::parse_event_t::object_end && !names.empty()) names.pop_back();
    // Texts go on to functions that end at a NUL, and would mean less than they say.
    if (value.is_string())
      nul = value.get_ref<const std::string&>().find('\0') != std::string::npos || nul;
    if (event == json::parse_event_t::key && !names.empty()) {
      twice = !names.back().insert(value.get<std::string>()).second || twice;
    }
    return !too_deep;
  };
  json document = json::parse(text, visit, false);
  const char* fault = too_deep                  ? "it is more than 64 deep"
                      : document.is_discarded() ? "it cannot be parsed"
                      : twice                   ? "an object has a name twice"
                      : nul                     ? "a text has a NUL"
                                                : nullptr;
  if (fault != nullptr) {
    return Error{ErrorCode::kInvalidArgument, std::string("the JSON is at fault: ") + fault,
                 "invalid-json"};
  }
  return document;
}

}  // namespace farhorizon
