// POST /jobs, cheapest checks first. From the head: media type and coding, length, Idempotency-Key,
// query, room for a job. Then the body goes to disk. From the body: form, parameters, first bytes,
// a worker's reading of the raster; then the stores.
#include "service/handlers/submit.h"

#include <memory>
#include <optional>
#include <string>
#include <utility>

#include "service/handlers/content_digest.h"
#include "service/handlers/execute.h"
#include "service/handlers/json.h"
#include "service/handlers/json_parameters.h"
#include "service/handlers/problem.h"
#include "service/handlers/raster_sniff.h"
#include "service/handlers/status_info.h"
#include "service/handlers/upload_body.h"
#include "service/handlers/upload_media.h"
#include "service/log.h"
#include "service/metrics.h"

namespace farhorizon {

namespace {

constexpr std::size_t kMaxKeyBytes = 256;

// The contents of the head of a submission.
struct SubmissionHead {
  Parameters parameters;  // of the query, except the file name, with the job's terms
  Wishes wishes;          // what they mean
  std::optional<std::string> filename;
  std::optional<std::string> idempotency_key;
  ContentDigest digest;
};

}  // namespace

Result<std::optional<std::string>> ReadIdempotencyKey(const HttpRequest& request) {
  const std::string* field = request.Header("idempotency-key");
  if (field == nullptr) return std::optional<std::string>();
  std::string_view key = Trimmed(*field);
  if (key.size() >= 2 && key.front() == '"' && key.back() == '"') {
    key = key.substr(1, key.size() - 2);
  }
  if (key.empty() || key.size() > kMaxKeyBytes) {
    return Error{ErrorCode::kInvalidArgument, "the Idempotency-Key must have 1 to 256 characters",
                 "invalid-idempotency-key"};
  }
  return std::optional<std::string>(key);
}

Result<Wishes> ReadWishes(Parameters parameters, const TermBounds& bounds) {
  Result<JobTerms> terms = TakeTerms(parameters, bounds);
  if (!terms) return std::move(terms.error());
  Result<BuildOptions> options = ParseOptions(parameters);
  if (!options) return std::move(options.error());
  if (Status checked = CheckOptions(*options); !checked) return std::move(checked.error());
  return Wishes{std::move(parameters), *terms, *std::move(options)};
}

namespace {

// Sets `head.wishes` from `head.parameters`.
Status SetWishes(const TermBounds& bounds, SubmissionHead& head) {
  Result<Wishes> wishes = ReadWishes(head.parameters, bounds);
  if (!wishes) return std::move(wishes.error());
  head.wishes = *std::move(wishes);
  return Ok{};
}

// Moves the file name out of the parameters of a job.
void TakeFilename(SubmissionHead& head) {
  const auto name = head.parameters.find("filename");
  if (name == head.parameters.end()) return;
  head.filename = name->second;
  head.parameters.erase(name);
}

Result<SubmissionHead> ReadSubmissionHead(const HttpRequest& request, const TermBounds& bounds) {
  Result<std::optional<std::string>> key = ReadIdempotencyKey(request);
  if (!key) return std::move(key.error());
  std::optional<Parameters> query = DecodeQuery(request.query, {"formats", "nodata", "triangles"});
  if (!query) {
    return Error{
        ErrorCode::kInvalidArgument,
        "the query cannot be read: a name is empty or stands twice, an escape is broken, or "
        "there is a NUL",
        "invalid-parameter"};
  }
  Result<ContentDigest> digest = ContentDigest::Of(request);
  if (!digest) return std::move(digest.error());
  SubmissionHead head{*std::move(query), {}, {}, *std::move(key), *std::move(digest)};
  TakeFilename(head);
  if (Status read = SetWishes(bounds, head); !read) return std::move(read.error());
  return head;
}

// Adds the parameters of a form to those of the query.
Status AddFormParameters(const std::string& json, const TermBounds& bounds, SubmissionHead& head) {
  Result<Parameters> form = ParametersOfJson(json);
  if (!form) return std::move(form.error());
  for (const auto& [name, value] : *form) {
    const bool in_query = name == "filename" && head.filename;
    if (!in_query && head.parameters.emplace(name, value).second) continue;
    return Error{ErrorCode::kInvalidArgument,
                 "the parameter " + name + " stands in the query and in the form",
                 "invalid-parameter"};
  }
  TakeFilename(head);
  return SetWishes(bounds, head);
}

class SubmitExchange : public Exchange {
 public:
  SubmitExchange(const HandlerContext& context, const HttpRequest& request, SubmissionHead head,
                 SpoolFile spool, const std::optional<std::string>& boundary)
      : context_(context),
        request_(request),
        head_(std::move(head)),
        body_(std::move(spool), context.max_body_bytes, boundary) {}

  Status Take(std::string_view piece) override {
    CountUploadedBytes(static_cast<std::int64_t>(piece.size()));
    head_.digest.Add(piece);
    return body_.Take(piece);
  }
  HttpResponse Finish() override;

 private:
  Result<Submission> ReadSubmission();
  Result<Job> Submit();

  const HandlerContext& context_;
  const HttpRequest& request_;
  SubmissionHead head_;
  UploadBody body_;
};

// Head and form joined.
Result<Submission> SubmitExchange::ReadSubmission() {
  if (body_.params()) {
    Status added = AddFormParameters(*body_.params(), context_.terms, head_);
    if (!added) return std::move(added.error());
  }
  const std::string name = head_.filename.value_or(body_.filename().value_or(""));
  return Submission{.filename = SafeFilename(name),
                    .parameters = std::move(head_.wishes.parameters),
                    .idempotency_key = std::move(head_.idempotency_key),
                    .client = ClientOf(request_),
                    .terms = head_.wishes.terms,
                    .options = std::move(head_.wishes.options),
                    .owner = request_.caller.owner};
}

Result<Job> SubmitExchange::Submit() {
  Status intact = head_.digest.Check();
  if (!intact) return std::move(intact.error());
  Status complete = body_.Finish();
  if (!complete) return std::move(complete.error());
  Result<Submission> submission = ReadSubmission();
  if (!submission) return std::move(submission.error());
  return SubmitUpload(context_, body_.spool(), *std::move(submission));
}

HttpResponse SubmitExchange::Finish() { return SubmittedResponse(context_, request_, Submit()); }

Admission BeginSubmission(const HandlerContext& context, const HttpRequest& request) {
  std::variant<UploadMedia, HttpResponse> media = ReadUploadMedia(request);
  if (auto* refusal = std::get_if<HttpResponse>(&media)) return std::move(*refusal);
  if (std::get<UploadMedia>(media).json) return BeginExecution(context, request, "");
  if (request.content_length.value_or(0) > context.max_body_bytes) {
    return ProblemResponse(request, ProblemOf(BodyTooLarge(context.max_body_bytes)));
  }
  Result<SubmissionHead> head = ReadSubmissionHead(request, context.terms);
  if (!head) return ProblemResponse(request, ProblemOf(head.error()));
  Result<SpoolFile> spool = SpoolForJob(context, request);
  if (!spool) return ProblemResponse(request, ProblemOf(spool.error()));
  return std::make_unique<SubmitExchange>(context, request, *std::move(head), *std::move(spool),
                                          std::get<UploadMedia>(media).boundary);
}

}  // namespace

std::string ClientOf(const HttpRequest& request) {
  return request.caller.owner.empty() ? request.peer : request.caller.owner;
}

Result<SpoolFile> SpoolForJob(const HandlerContext& context, const HttpRequest& request) {
  Status room = context.jobs.CheckRoom(ClientOf(request));
  if (!room) return std::move(room.error());
  Result<SpoolFile> spool = context.jobs.NewSpoolFile();
  if (!spool) Log(LogLevel::kError, "cannot spool", {{"error", spool.error().message}});
  return spool;
}

Result<Job> SubmitUpload(const HandlerContext& context, const SpoolFile& spool,
                         Submission submission) {
  Status upload = CheckUpload(spool.beginning(), spool.bytes(), submission.filename);
  if (!upload) {
    Error error = std::move(upload.error());
    if (submission.filename == kNoFilename) {
      error.message += "; formats that a name tells need it, as ?filename=N46E007.hgt";
    }
    return error;
  }
  Result<ProbeReport> report = context.jobs.Probe(spool, submission);
  if (!report) return std::move(report.error());
  submission.assumptions = std::move(report->assumptions);
  submission.cost = report->cost;
  return context.jobs.Submit(spool, submission);
}

HttpResponse SubmittedResponse(const HandlerContext& context, const HttpRequest& request,
                               const Result<Job>& job) {
  if (!job) {
    const Problem problem = ProblemOf(job.error());
    if (problem.status >= 500) {
      Log(LogLevel::kError, "submission failed", {{"error", job.error().message}});
    }
    return ProblemResponse(request, problem);
  }
  HttpResponse response = JsonResponse(StatusInfo(*job, context.base));
  response.status = 201;
  response.job_id = job->id;
  response.Set("Location", context.base + "/jobs/" + job->id);
  response.Set("Retry-After", "1");
  return response;
}

Route SubmitRoute(const HandlerContext& context) {
  return {"POST", "/jobs",
          [context](const HttpRequest& request) { return BeginSubmission(context, request); },
          WaitsFor::kProcess};
}

}  // namespace farhorizon
