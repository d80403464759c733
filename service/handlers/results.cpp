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
#include "service/handlers/result_archive.h"
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
  const std::optional<Parameters> query = DecodeQuery(request.query);
  const auto form = query ? query->find("f") : Parameters::const_iterator();
  const bool asked = query && form != query->end() && form->second != "json";
  if (asked && form->second != "zip" && form->second != "tar") {
    return ProblemResponse(request, {"invalid-query-parameter-value", "f is json, zip or tar"});
  }
  HttpResponse response = asked ? SendArchive(context, request, *job, form->second)
                                : AnswerResults(context, request, *job);
  response.job_id = job->id;
  return response;
}

// For a page, the one artifact that a browser shows and runs: its own script and style, no loads,
// no origin. Whatever a stranger's DEM brought into the page would not reach this service in the
// reader's name. A page names its script's hash itself; here are pages of all versions.
constexpr const char* kPagePolicy =
    "default-src 'none'; img-src data:; style-src 'unsafe-inline'; script-src 'unsafe-inline'; "
    "base-uri 'none'; form-action 'none'; frame-ancestors 'none'; sandbox allow-scripts";

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

HttpResponse SendSource(const HttpRequest& request, SentSource sent) {
  const Selection selection = SelectBytes(request, sent.etag, sent.bytes);
  HttpResponse response;
  response.status = selection.status;
  if (selection.status == 416) {
    response = ProblemResponse(
        request, {"range-not-satisfiable", "the artifact has " + std::to_string(sent.bytes) +
                                               " bytes; the range starts after them"});
    response.Set("Content-Range", "bytes */" + std::to_string(sent.bytes));
    return response;
  }
  if (selection.status == 412) {
    return ProblemResponse(
        request, {"precondition-failed", "the artifact is not the one that If-Match names"});
  }
  response.Set("ETag", sent.etag);
  response.Set("Cache-Control", "private, max-age=31536000, immutable");
  if (selection.status == 304) return response;
  response.Set("Content-Type", sent.media_type);
  response.Set("Accept-Ranges", "bytes");
  response.Set("Content-Disposition", sent.disposition);
  if (selection.status == 206) {
    response.Set("Content-Range", "bytes " + std::to_string(selection.offset) + "-" +
                                      std::to_string(selection.offset + selection.bytes - 1) + "/" +
                                      std::to_string(sent.bytes));
  }
  response.file = FileBody{std::move(sent.source), selection.offset, selection.bytes};
  return response;
}

Result<std::shared_ptr<BodySource>> OpenSource(JobService& jobs, const std::string& id,
                                               const std::string& name) {
  Result<OpenArtifact> open = jobs.Open(id, name);
  if (!open) return std::move(open.error());
  return std::shared_ptr<BodySource>(std::make_shared<ArtifactSource>(std::move(open->object)));
}

HttpResponse SendArtifact(const HttpRequest& request, OpenArtifact open) {
  const StoredObject& stored = open.stored;
  const bool page = MediaTypeIn(open.artifact.media_type) == "text/html";
  HttpResponse response =
      SendSource(request, {.source = std::make_shared<ArtifactSource>(std::move(open.object)),
                           .bytes = stored.bytes,
                           .etag = "\"" + stored.sha256 + "\"",
                           .media_type = open.artifact.media_type,
                           .disposition = std::string(page ? "inline" : "attachment") +
                                          "; filename=\"" + open.artifact.name + "\""});
  if (response.status >= 400) return response;
  response.Set("Vary", "Accept-Encoding");
  if (response.status == 304) return response;
  const Coding coding = IsStoredInGzip(open.artifact) ? Coding::kGzip : open.coding;
  if (coding != Coding::kIdentity)
    response.Set("Content-Encoding", std::string(CodingName(coding)));
  if (page) {
    response.Set("Content-Security-Policy", kPagePolicy);
    // Its address may have a ticket.
    response.Set("Referrer-Policy", "no-referrer");
  }
  const std::optional<Digest> digest = Digest::FromHex(stored.sha256);
  Check(digest.has_value(), "an object's name is a sha256");
  response.Set("Repr-Digest", "sha-256=:" + digest->Base64() + ":");
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
  Result<OpenArtifact> open =
      context.jobs.Open(job->id, request.parameters.at(1), AcceptedCodings(request));
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
