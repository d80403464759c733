#pragma once

#include <cstddef>
#include <string_view>
#include <variant>

#include "service/handlers/http_message.h"
#include "service/handlers/problem.h"

namespace farhorizon {

struct GateLimits {
  std::size_t target_bytes = 8000;
  std::size_t header_fields = 100;
};

/// Reads the head of a request, its closing empty line included, or says why the connection ends.
///
/// Stricter than RFC 9112 asks, since whatever two readers may read in two ways is how requests are
/// smuggled: CRLF alone ends lines; fields do not fold; exactly one Host (of HTTP/1.1); targets in
/// origin form of visible ASCII; one Content-Length of digits or `Transfer-Encoding: chunked`, never
/// both; only ASCII in fields.
std::variant<HttpRequest, Problem> ReadHead(std::string_view head, const GateLimits& limits);

}  // namespace farhorizon
