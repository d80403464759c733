#pragma once

#include <string>

#include <nlohmann/json.hpp>

#include "service/handlers/http_message.h"

namespace farhorizon {

/// `document` as UTF-8 text on one line, with a newline at its end. Bytes that are not UTF-8 are
/// replaced by U+FFFD.
std::string DumpJson(const nlohmann::ordered_json& document);

/// The entity tag of a document with this text, with its quotes.
std::string TagOf(const std::string& text);

/// 200 with `document` as application/json, not to be cached.
HttpResponse JsonResponse(const nlohmann::ordered_json& document);

/// The same with an entity tag, for what clients ask for again and again: 304 to a client that has
/// this document, 412 where If-Match names another.
/// type: the media type, of JSON.
HttpResponse TaggedJsonResponse(const HttpRequest& request, const nlohmann::ordered_json& document,
                                const char* type = "application/json");

}  // namespace farhorizon
