#include "service/handlers/linked_input.h"

#include <string_view>
#include <utility>

#include "core/io/sha256.h"
#include "service/handlers/key_gate.h"
#include "service/handlers/submit.h"
#include "service/outgoing/fetcher.h"

namespace farhorizon {

namespace {

// To `error`, of a link that may not be: what to write where an upload was meant.
Error WithRemedy(Error error, const InputLink& link) {
  if (link.href.find("uploads") != std::string::npos) {
    error.message += "; an upload to this service is linked to as /uploads/ID";
  }
  return error;
}

}  // namespace

Result<Job> SubmitLinked(const HandlerContext& context, const HttpRequest& request,
                         const InputLink& link, SpoolFile& spool, Submission submission) {
  if (!context.fetcher) {
    return WithRemedy(
        {ErrorCode::kInvalidArgument,
         "the input dem is a link to elsewhere, and this service fetches nothing: send the value "
         "itself, link to an upload of this service (POST /uploads), or let fetch.allow of its "
         "configuration name how the link begins",
         "href-not-allowed"},
        link);
  }
  const Result<OutgoingUrl> url = context.fetcher->Check(link.href);
  if (!url) return WithRemedy(url.error(), link);
  if (submission.filename == kNoFilename) submission.filename = SafeFilename(url->path);
  // Not the link itself: one that is signed is a secret.
  submission.source = Sha256Hex(url->text);
  Result<std::optional<Job>> earlier = context.jobs.FindEarlier(submission);
  if (!earlier) return std::move(earlier.error());
  if (*earlier) return **std::move(earlier);
  const Status fetched = context.fetcher->Fetch(
      *url, context.max_body_bytes, [&](std::string_view piece) { return spool.Write(piece); });
  if (context.gate) context.gate->CountUpload(request, spool.bytes());
  if (!fetched) return fetched.error();
  return SubmitUpload(context, spool, std::move(submission));
}

}  // namespace farhorizon
