#pragma once

#include <cstdint>
#include <string>

#include "service/handlers/http_message.h"

namespace farhorizon {

/// The part of a file that answers a request for it [RFC 9110, sections 13 and 14].
struct Selection {
  int status = 200;  ///< 200, 206, 304, 412 or 416
  std::int64_t offset = 0;
  std::int64_t bytes = 0;
};

/// What the conditions If-Match and If-None-Match make of a request for what has the entity tag
/// `etag`, with its quotes: 200, 304 or 412.
int StatusByConditions(const HttpRequest& request, const std::string& etag);

/// Evaluates If-Match, If-None-Match, If-Range and Range, in this order, for a file of `size`
/// bytes. etag: the file's strong entity tag, with its quotes. Several ranges, or one that is not
/// well formed, select the whole file, as section 14.2 allows.
Selection SelectBytes(const HttpRequest& request, const std::string& etag, std::int64_t size);

}  // namespace farhorizon
