#pragma once

#include <string>
#include <string_view>

#include <nlohmann/json.hpp>

#include "core/base/result.h"

namespace farhorizon {

/// UTF-8 text with a newline; what is no UTF-8 in it is replaced, never thrown.
inline std::string DumpJson(const nlohmann::ordered_json& document) {
  return document.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace) + "\n";
}

/// Parses what a client sent: at most 64 deep, no name twice in an object.
/// Errors: kInvalidArgument "invalid-json".
Result<nlohmann::json> ParseClientJson(std::string_view text);

}  // namespace farhorizon
