#pragma once

#include <nlohmann/json.hpp>

#include "core/base/result.h"
#include "service/handlers/handler_context.h"
#include "service/handlers/http_message.h"

namespace farhorizon {

/// The results of a successful job as its execute request wished for them: a JSON document; one
/// output's bytes; several in multipart/related; or 204 with a Link to each. Without wishes it is
/// the document, with a link to each artifact.
///
/// Values in one response have 4 MiB together at most: further ones are sent as links. Where there
/// would be more than a hundred fields Link, the document takes their place.
HttpResponse AnswerResults(const HandlerContext& context, const HttpRequest& request,
                           const Job& job);

/// The document with a link to each artifact that was asked for, none as a value.
/// Errors: those of JobService.
Result<nlohmann::ordered_json> ResultLinks(const HandlerContext& context, const Job& job);

}  // namespace farhorizon
