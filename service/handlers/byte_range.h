#pragma once

#include <cstdint>
#include <string>

#include "service/handlers/http_message.h"

namespace farhorizon {

/// What is to be sent of a file of `size` bytes (RFC 9110, sections 13 and 14).
struct Selection {
  int status = 200;  ///< 200, 206, 304, 412 or 416
  std::int64_t offset = 0;
  std::int64_t bytes = 0;
};

/// Judges If-Match, If-None-Match, If-Range and Range, in this order. etag: strong, with its quotes.
/// More than one range, or one that is not well formed, is answered in full as section 14.2 allows.
Selection SelectBytes(const HttpRequest& request, const std::string& etag, std::int64_t size);

}  // namespace farhorizon
