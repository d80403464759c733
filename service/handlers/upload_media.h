#pragma once

#include <optional>
#include <string>
#include <variant>

#include "service/handlers/http_message.h"

namespace farhorizon {

/// How the body of a submission is to be read.
struct UploadMedia {
  std::optional<std::string> boundary;  ///< that of the form; unset: the body is the DEM itself
};

/// Reads Content-Type and Content-Encoding of a submission; or the response that refuses it, which
/// names what would be taken [RFC 9110, sections 12.5.3 and 15.5.16]. A body without a Content-Type
/// is the DEM itself (section 8.3).
std::variant<UploadMedia, HttpResponse> ReadUploadMedia(const HttpRequest& request);

}  // namespace farhorizon
