#pragma once

#include <string_view>

#include <nlohmann/json.hpp>

#include "core/base/result.h"

namespace farhorizon {

/// Parses JSON that somebody else wrote: at most 64 levels deep, no name twice in an object, no NUL
/// in a name or a text.
/// Errors: kInvalidArgument "invalid-json".
Result<nlohmann::json> ParseStrictJson(std::string_view text);

}  // namespace farhorizon
