#pragma once

#include <vector>

#include "service/handlers/http_message.h"
#include "service/jobs/coding.h"

namespace farhorizon {

/// The codings that the request would rather have a response in than as it is, best first: those
/// to which its Accept-Encoding gives a weight that is not 0 and not below that of identity
/// [RFC 9110, section 12.5.3]; zstd, which makes less, before gzip where both weigh the same. `*`
/// is gzip: who names nothing may not know zstd. None for a request without the field, or with one
/// that cannot be read.
std::vector<Coding> AcceptedCodings(const HttpRequest& request);

/// True where gzip is among them.
bool AcceptsGzip(const HttpRequest& request);

}  // namespace farhorizon
