#pragma once

#include <optional>
#include <string>

#include <nlohmann/json.hpp>

#include "core/base/result.h"
#include "service/handlers/handler_context.h"
#include "service/handlers/http_message.h"
#include "service/jobs/upload.h"

namespace farhorizon {

/// A DEM that an execute request names in place of its bytes: {"href": …, "type": …}.
struct InputLink {
  std::string href;
  std::string type;  ///< empty where the link has none
};

/// The link that the input `dem` is; nullopt where it is none.
/// Errors: kInvalidArgument "invalid-parameter" for a link that is not one of OGC API - Processes.
Result<std::optional<InputLink>> ReadLink(const nlohmann::json& given);

/// The id of the upload of this service that the URL names: /uploads/ID, below the public URL,
/// below the name that the request itself came by, or without either; nullopt for all other URLs.
std::optional<std::string> OwnUploadOf(const HandlerContext& context, const HttpRequest& request,
                                       const std::string& href);

/// The caller's upload, all of which is there.
/// Errors: kNotFound "no-such-upload"; kInvalidArgument "upload-incomplete"; those of the store.
Result<Upload> FindWholeUpload(const HandlerContext& context, const HttpRequest& request,
                               const std::string& id);

}  // namespace farhorizon
