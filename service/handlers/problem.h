#pragma once

#include <string>

#include "core/base/result.h"
#include "service/handlers/http_message.h"

namespace farhorizon {

/// An error as the wire shows it [RFC 9457]; type and title follow from code and status.
struct Problem {
  /// With the status of `kind`.
  Problem(ErrorKind kind, std::string text);

  int status;
  ErrorKind code;      ///< for programs to switch on; proto/errors.md lists all
  std::string detail;  ///< for the person who can act
};

/// kInvalidArgument "invalid-parameter".
Error InvalidParameter(const std::string& what);

/// The HTTP status of `kind`: one for each of kErrorKinds.
int HttpStatusOf(ErrorKind kind);

/// The problem that `error` is to a client. Its code is the kind, or the name of the ErrorCode of
/// an error without a kind. Its detail names parameters where the message names flags. The message
/// of a failure of the storage or of this program is withheld.
Problem ProblemOf(const Error& error);

/// The type URI of a code: OGC's where OGC names one, else ours; the same on every host.
std::string ProblemType(ErrorKind code);

/// The response that shows `problem`: application/problem+json, or application/json if the request
/// accepts only that; with Retry-After where trying again makes sense.
HttpResponse ProblemResponse(const HttpRequest& request, const Problem& problem);

}  // namespace farhorizon
