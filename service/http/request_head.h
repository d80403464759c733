#pragma once

#include <cstddef>
#include <string_view>
#include <variant>

#include "service/handlers/http_message.h"
#include "service/handlers/problem.h"

namespace farhorizon {

struct RequestHeadLimits {
  std::size_t target_bytes = 8000;
  std::size_t header_fields = 100;
};

/// Reads the head of a request, up to and with its closing empty line; or the problem for which the
/// request is refused and its connection closed.
///
/// Stricter than [RFC 9112] asks: requests are smuggled where two readers of the same bytes may
/// differ (section 11.2). Lines end in CRLF alone (section 2.2); a field does not continue on a
/// second line (5.2) and holds ASCII only; HTTP/1.1 has exactly one Host (3.2); a target is in
/// origin form (3.2.1), or `*` of OPTIONS; a body has one Content-Length of digits or
/// `Transfer-Encoding: chunked`, never both (6.3).
std::variant<HttpRequest, Problem> ReadRequestHead(std::string_view head,
                                                   const RequestHeadLimits& limits);

}  // namespace farhorizon
