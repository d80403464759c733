#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <variant>

#include "service/handlers/http_message.h"

namespace farhorizon {

/// How the body of a submission is to be read: where nothing is set, it is the DEM itself.
struct UploadMedia {
  std::optional<std::string> boundary = {};  ///< that of the form
  bool json = false;                         ///< the body is an execute request
};

/// Reads Content-Type and Content-Encoding of a submission; or the response that refuses it, which
/// names what would be taken [RFC 9110, sections 12.5.3 and 15.5.16]. A body without a Content-Type
/// is the DEM itself (section 8.3).
std::variant<UploadMedia, HttpResponse> ReadUploadMedia(const HttpRequest& request);

/// The same where the body can be an execute request alone.
std::variant<UploadMedia, HttpResponse> ReadExecutionMedia(const HttpRequest& request);

/// Whether this is a type, without parameters, that programs give to files of heights; an empty one
/// is.
bool IsDemMediaType(std::string_view media);

}  // namespace farhorizon
