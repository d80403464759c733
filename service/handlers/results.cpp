#include "service/handlers/results.h"

#include <memory>
#include <optional>
#include <string>
#include <utility>

#include "core/io/sha256.h"
#include "service/handlers/byte_range.h"
#include "service/handlers/content_coding.h"
#include "service/handlers/jobs.h"
#include "service/handlers/problem.h"
#include "service/handlers/result_answer.h"
#include "service/log.h"
#include "service/metrics.h"

namespace farhorizon {

namespace {

// The job, if it has results; else the error that answers a request for them. For a failed job that
// is the error it failed with.
Result<Job> FinishedJob(const HandlerContext& context, const HttpRequest& request) {
  Result<Job> job = FindJob(context, request);
  if (!job || job->state == JobState::kSuccessful) return job;
  switch (job->state) {
    case JobState::kAccepted:
    case JobState::kRunning:
      return Error{ErrorCode::kNotFound,
                   "the job is still " + std::string(JobStateName(job->state)), "result-not-ready"};
    case JobState::kFailed:
      Check(job->failure.has_value(), "a failed job has its failure");
      return *job->failure;
    default:
      return NoResults();
  }
}

HttpResponse ListResults(const HandlerContext& context, const HttpRequest& request) {
  Result<Job> job = FinishedJob(context, request);
  if (!job) return ProblemResponse(request, ProblemOf(job.error()));
  HttpResponse response = AnswerResults(context, request, *job);
  response.job_id = job->id;
  return response;
}

// For a page, the one artifact that a browser shows and runs: its own script and style, no loads,
// no origin. Whatever a stranger's DEM brought into the page would not reach this service in the
// reader's name. A page names its script's hash itself; here are pages of all versions.
constexpr const char* kPagePolicy =
    "default-src 'none'; img-src data:; style-src 'unsafe-inline'; script-src 'unsafe-inline'; "
    "base-uri 'none'; form-action 'none'; frame-ancestors 'none'; sandbox allow-scripts";

void SetDisposition(HttpResponse& response, const Artifact& artifact) {
  const bool page = MediaTypeIn(artifact.media_type) == "text/html";
  response.Set("Content-Disposition", std::string(page ? "inline" : "attachment") +
                                          "; filename=\"" + artifact.name + "\"");
  if (!page) return;
  response.Set("Content-Security-Policy", kPagePolicy);
  // Its address may have a ticket.
  response.Set("Referrer-Policy", "no-referrer");
}

// Tiles of terrain are files in gzip, for servers that know of nothing else; there is no other
// representation of them, so that all get this one.
bool IsStoredInGzip(const Artifact& artifact) {
  return MediaTypeIn(artifact.media_type) == "application/vnd.quantized-mesh";
}

// The artifact piece by piece, each verified.
class ArtifactSource : public BodySource {
 public:
  explicit ArtifactSource(std::shared_ptr<VerifiedObject> object) : object_(std::move(object)) {}

  Result<std::string_view> Read(std::int64_t offset, std::int64_t most) override {
    Result<std::string_view> bytes = object_->Read(offset, most);
    if (!bytes) {
      CountCorruptResult();
      Log(LogLevel::kError, "artifact damaged while it was sent",
          {{"error", bytes.error().message}});
    }
    return bytes;
  }

 private:
  std::shared_ptr<VerifiedObject> object_;
};

}  // namespace

HttpResponse SendArtifact(const HttpRequest& request, OpenArtifact open) {
  const StoredObject& stored = open.stored;
  const std::string etag = "\"" + stored.sha256 + "\"";
  const Selection selection = SelectBytes(request, etag, stored.bytes);
  HttpResponse response;
  response.status = selection.status;
  if (selection.status == 416) {
    response = ProblemResponse(
        request, {"range-not-satisfiable", "the artifact has " + std::to_string(stored.bytes) +
                                               " bytes; the range starts after them"});
    response.Set("Content-Range", "bytes */" + std::to_string(stored.bytes));
    return response;
  }
  if (selection.status == 412) {
    return ProblemResponse(
        request, {"precondition-failed", "the artifact is not the one that If-Match names"});
  }
  response.Set("ETag", etag);
  response.Set("Vary", "Accept-Encoding");
  response.Set("Cache-Control", "private, max-age=31536000, immutable");
  if (selection.status == 304) return response;
  response.Set("Content-Type", open.artifact.media_type);
  if (open.coding == Coding::kGzip || IsStoredInGzip(open.artifact)) {
    response.Set("Content-Encoding", "gzip");
  }
  response.Set("Accept-Ranges", "bytes");
  SetDisposition(response, open.artifact);
  if (selection.status == 206) {
    response.Set("Content-Range", "bytes " + std::to_string(selection.offset) + "-" +
                                      std::to_string(selection.offset + selection.bytes - 1) + "/" +
                                      std::to_string(stored.bytes));
  }
  const std::optional<Digest> digest = Digest::FromHex(stored.sha256);
  Check(digest.has_value(), "an object's name is a sha256");
  response.Set("Repr-Digest", "sha-256=:" + digest->Base64() + ":");
  response.file = FileBody{std::make_shared<ArtifactSource>(std::move(open.object)),
                           selection.offset, selection.bytes};
  return response;
}

Error NoResults() {
  return {ErrorCode::kNotFound, "the job was dismissed and has no results", "result-not-available"};
}

HttpResponse LostArtifact(const HttpRequest& request, const Job& job, const Error& error) {
  const Problem problem = ProblemOf(error);
  if (problem.status >= 500) {
    Log(LogLevel::kError, "artifact lost", {{"job_id", job.id}, {"error", error.message}});
  }
  return ProblemResponse(request, problem);
}

namespace {

HttpResponse GetArtifact(const HandlerContext& context, const HttpRequest& request) {
  Result<Job> job = FinishedJob(context, request);
  if (!job) return ProblemResponse(request, ProblemOf(job.error()));
  const Coding coding = AcceptsGzip(request) ? Coding::kGzip : Coding::kIdentity;
  Result<OpenArtifact> open = context.jobs.Open(job->id, request.parameters.at(1), coding);
  if (!open) return LostArtifact(request, *job, open.error());
  HttpResponse response = SendArtifact(request, *std::move(open));
  response.job_id = job->id;
  return response;
}

}  // namespace

std::vector<Route> ResultRoutes(const HandlerContext& context) {
  return {BodylessRoute(
              "GET", "/jobs/{id}/results",
              [context](const HttpRequest& request) { return ListResults(context, request); }),
          BodylessRoute("GET", "/jobs/{id}/results/{name}", [context](const HttpRequest& request) {
            return GetArtifact(context, request);
          })};
}

}  // namespace farhorizon
