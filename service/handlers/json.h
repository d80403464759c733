#pragma once

#include <string>
#include <string_view>

#include <nlohmann/json.hpp>

#include "core/base/result.h"
#include "service/handlers/http_message.h"

namespace farhorizon {

/// `document` as UTF-8 text on one line, with a newline at its end. Bytes that are not UTF-8 are
/// replaced by U+FFFD.
std::string DumpJson(const nlohmann::ordered_json& document);

/// 200 with `document` as application/json, not to be cached.
HttpResponse JsonResponse(const nlohmann::ordered_json& document);

/// Parses JSON that a client sent: at most 64 levels deep, no name twice in an object.
/// Errors: kInvalidArgument "invalid-json".
Result<nlohmann::json> ParseClientJson(std::string_view text);

}  // namespace farhorizon
