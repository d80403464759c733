#pragma once

#include <optional>
#include <string>

#include "core/pipeline/build_options.h"
#include "service/handlers/handler_context.h"
#include "service/handlers/router.h"

namespace farhorizon {

/// POST /jobs. The body is a DEM, with its parameters in the query, a multipart form with the parts
/// `dem` and `params`, or an execute request as JSON.
Route SubmitRoute(const HandlerContext& context);

/// What the parameters of a job ask for.
struct Wishes {
  Parameters parameters = {};  ///< of the build
  JobTerms terms = {};
  BuildOptions options = {};
};
/// Errors: kInvalidArgument; those of TakeTerms and ParseOptions.
Result<Wishes> ReadWishes(Parameters parameters, const TermBounds& bounds);

/// The value of the field Idempotency-Key, which holds a quoted string; text without the quotes is
/// taken, too. Errors: kInvalidArgument "invalid-idempotency-key".
Result<std::optional<std::string>> ReadIdempotencyKey(const HttpRequest& request);

/// Whose turn a job takes: each key's owner has one, and where no key is asked for each address.
std::string ClientOf(const HttpRequest& request);

/// A file for the body of a request that makes a job. Errors: those of JobService::CheckRoom and of
///   the file.
Result<SpoolFile> SpoolForJob(const HandlerContext& context, const HttpRequest& request);

/// Looks into an upload and makes a job of it. Errors: those of CheckUpload, JobService::Probe and
///   JobService::Submit.
Result<Job> SubmitUpload(const HandlerContext& context, const SpoolFile& spool,
                         Submission submission);

/// The answer to a request that made this job, or did not.
HttpResponse SubmittedResponse(const HandlerContext& context, const HttpRequest& request,
                               const Result<Job>& job);

}  // namespace farhorizon
