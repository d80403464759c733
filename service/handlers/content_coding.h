#pragma once

#include "service/handlers/http_message.h"

namespace farhorizon {

/// True where the request would rather have a response in gzip than as it is: its Accept-Encoding
/// gives gzip, x-gzip or * a weight that is not 0 and not below that of identity [RFC 9110,
/// section 12.5.3]. A request without the field, or with one that cannot be read, would not.
bool AcceptsGzip(const HttpRequest& request);

}  // namespace farhorizon
