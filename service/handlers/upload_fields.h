#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "core/base/result.h"
#include "service/handlers/http_message.h"

namespace farhorizon {

/// The version of the protocol of resumable uploads that is spoken [Tus].
inline constexpr const char* kTusVersion = "1.0.0";

/// kInvalidArgument "invalid-upload".
Error InvalidUpload(const std::string& why);

/// The response to a request that speaks another version, or says none; nullopt to one of this
/// version.
std::optional<HttpResponse> RefuseTusVersion(const HttpRequest& request);

/// The field Upload-Length; nullopt where there is none. Numbers beyond 10^18 are given as that.
/// Errors: kInvalidArgument "invalid-upload".
Result<std::optional<std::int64_t>> ReadUploadLength(const HttpRequest& request);
/// Of a request that makes an upload: nullopt where Upload-Defer-Length says that the length comes
/// later. Errors: kInvalidArgument "invalid-upload" where both fields or none are there.
Result<std::optional<std::int64_t>> ReadNewUploadLength(const HttpRequest& request);
/// The field Upload-Offset. Errors: kInvalidArgument "invalid-upload", also without it.
Result<std::int64_t> ReadUploadOffset(const HttpRequest& request);

/// The contents of the field Upload-Metadata.
struct UploadMetadata {
  std::string text;       ///< as it was sent
  std::string filename;   ///< of the key `filename`, or `name`; empty without one
  std::string file_type;  ///< of the key `filetype`, or `type`; likewise
};
/// Errors: kInvalidArgument "invalid-upload": it is longer than 4096 bytes, a key is empty or there
///   twice, a value is no base64 or has control characters.
Result<UploadMetadata> ReadUploadMetadata(const HttpRequest& request);

}  // namespace farhorizon
