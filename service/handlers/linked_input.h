#pragma once

#include "core/base/result.h"
#include "service/handlers/handler_context.h"
#include "service/handlers/http_message.h"
#include "service/handlers/input_link.h"

namespace farhorizon {

/// Makes a job of the DEM that a link to elsewhere leads to: looks whether the submission's
/// idempotency key has made one of the same link, whose DEM is not fetched again; fetches it into
/// `spool`; goes on as SubmitUpload. A DEM without a file name takes that of the link's path.
/// Blocks as long as a fetch may.
/// Errors: those of Fetcher; kInvalidArgument "idempotency-key-reused"; those of SubmitUpload.
Result<Job> SubmitLinked(const HandlerContext& context, const HttpRequest& request,
                         const InputLink& link, SpoolFile& spool, Submission submission);

}  // namespace farhorizon
