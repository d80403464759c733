#include "service/http/response_head.h"

#include <algorithm>
#include <string_view>

#include "service/clock.h"

namespace farhorizon {

std::string ResponseHead(const HttpRequest& request, const HttpResponse& response, bool keep_alive,
                         const Cors& cors) {
  std::string head =
      "HTTP/1.1 " + std::to_string(response.status) + " " + ReasonPhrase(response.status) + "\r\n";
  const auto add = [&head](std::string_view name, std::string_view value) {
    head.append(name).append(": ").append(value).append("\r\n");
  };
  for (const auto& [name, value] : response.headers) add(name, value);
  if (response.events) {
    // To a client of HTTP/1.0 the end of the connection is the end of the body.
    if (request.version != 10) add("Transfer-Encoding", "chunked");
  } else if (response.status != 204 && response.status != 304) {
    add("Content-Length", std::to_string(response.BodyBytes()));
  }
  add("Date", FormatHttpDate(NowMs()));
  add("Connection", keep_alive ? "keep-alive" : "close");
  add("X-Content-Type-Options", "nosniff");
  // Errors have it, too [Tus, "Tus-Resumable"].
  if (request.path == "/uploads" || request.path.starts_with("/uploads/")) {
    add("Tus-Resumable", "1.0.0");
  }
  // A handler that has a page says what the page may do; nothing else is one.
  const bool has_policy =
      std::any_of(response.headers.begin(), response.headers.end(),
                  [](const auto& field) { return field.first == "Content-Security-Policy"; });
  if (!has_policy) add("Content-Security-Policy", "default-src 'none'");
  if (!cors.readable_by.empty()) {
    add("Access-Control-Allow-Origin", cors.readable_by);
    add("Access-Control-Expose-Headers",
        "Location, ETag, Link, Retry-After, Preference-Applied, Content-Range, Accept-Ranges, "
        "Repr-Digest, WWW-Authenticate, Tus-Resumable, Tus-Version, Tus-Max-Size, Tus-Extension, "
        "Tus-Checksum-Algorithm, Upload-Offset, Upload-Length, Upload-Defer-Length, "
        "Upload-Metadata, Upload-Expires");
  }
  if (cors.depends_on_origin) add("Vary", "Origin");
  if (!request.caller.key_id.empty()) add("Vary", "Authorization");
  if (!request.request_id.empty()) add("X-Request-Id", request.request_id);
  return head + "\r\n";
}

}  // namespace farhorizon
