#pragma once

#include <string>

#include "core/base/result.h"
#include "service/handlers/http_message.h"

namespace farhorizon {

/// An error as the wire shows it (RFC 9457): type and title follow from status and code.
struct Problem {
  int status = 500;
  std::string code;    ///< short, stable, for programs to switch on
  std::string detail;  ///< for the person who can act
};

/// The HTTP status and code of `error`. What is the fault of storage or of us tells no detail.
Problem ProblemOf(const Error& error);

/// The type URI of a code: OGC's where OGC names one, else ours; the same on every host.
std::string ProblemType(const std::string& code);

/// application/problem+json, or application/json where the request accepts only that. Retry-After
/// where trying again makes sense.
HttpResponse ProblemResponse(const HttpRequest& request, const Problem& problem);

}  // namespace farhorizon
