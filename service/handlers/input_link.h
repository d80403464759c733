#pragma once

#include <optional>
#include <string>

#include <nlohmann/json.hpp>

#include "core/base/result.h"
#include "service/handlers/handler_context.h"
#include "service/handlers/http_message.h"
#include "service/jobs/upload.h"

namespace farhorizon {

/// An input that is named by a URL, not sent.
struct InputLink {
  std::string href;
  std::string type;  ///< what the request says that it is; may be empty
};

/// The link that the input is; nullopt where it is a value.
/// Errors: kInvalidArgument "invalid-parameter" where `href` is no text, or stands beside a value.
Result<std::optional<InputLink>> LinkOf(const std::string& name, const nlohmann::json& given);

/// The id of the upload of this service that the URL names: /uploads/ID, below the public URL,
/// below the name that the request itself came by, or without either; nullopt for all other URLs.
std::optional<std::string> OwnUploadOf(const HandlerContext& context, const HttpRequest& request,
                                       const std::string& href);

/// The caller's upload that the link names, all of which is there.
/// Errors: kInvalidArgument "href-not-allowed" for any other URL, "upload-incomplete"; kNotFound
///   "no-such-upload"; those of the store.
Result<Upload> LinkedUpload(const HandlerContext& context, const HttpRequest& request,
                            const InputLink& link);

/// "href-not-allowed".
Error HrefNotAllowed(const std::string& input);

}  // namespace farhorizon
