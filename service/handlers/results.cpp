#include "service/handlers/byte_range.h"
#include "service/handlers/problem.h"
#include "service/handlers/routes.h"
#include "service/log.h"

namespace farhorizon {

namespace {

/// The job, if it has results; else the answer to whoever asks for them. A failed job's is the
/// status that its cause has.
Result<Job> FinishedJob(const HandlerContext& context, const std::string& id) {
  if (!IsJobId(id)) return NoSuchJob();
  Result<Job> job = context.jobs.Find(id);
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
      return Error{ErrorCode::kNotFound, "the job was dismissed and has no results",
                   "result-not-available"};
  }
}

HttpResponse ListResults(const HandlerContext& context, const HttpRequest& request) {
  Result<Job> job = FinishedJob(context, request.parameters.at(0));
  if (!job) return ProblemResponse(request, ProblemOf(job.error()));
  Result<std::vector<Artifact>> artifacts = context.jobs.Artifacts(job->id);
  if (!artifacts) return ProblemResponse(request, ProblemOf(artifacts.error()));
  nlohmann::ordered_json document = nlohmann::ordered_json::object();
  for (const Artifact& artifact : *artifacts) {
    document[artifact.name] = {
        {"href", context.base + "/jobs/" + job->id + "/results/" + artifact.name},
        {"type", artifact.media_type},
        {"title", artifact.name},
        {"length", artifact.bytes},
        {"sha256", artifact.sha256}};
  }
  return JsonResponse(document);
}

std::string Base64OfHex(const std::string& hex) {
  static constexpr std::string_view kDigits =
      "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  const auto nibble = [&](std::size_t i) {
    const char c = hex[i];
    return static_cast<unsigned>(c <= '9' ? c - '0' : c - 'a' + 10);
  };
  std::string text;
  for (std::size_t i = 0; i < hex.size(); i += 6) {
    unsigned bits = 0;
    for (std::size_t k = i; k < i + 6; ++k) bits = bits * 16 + (k < hex.size() ? nibble(k) : 0);
    for (std::size_t k = 0; k < 4; ++k) {
      const bool padding = i + k * 3 / 2 >= hex.size();
      text += padding ? '=' : kDigits[(bits >> (18 - 6 * k)) & 63U];
    }
  }
  return text;
}

HttpResponse SendArtifact(const HttpRequest& request, OpenArtifact open) {
  const Artifact& artifact = open.artifact;
  const std::string etag = "\"" + artifact.sha256 + "\"";
  const Selection selection = SelectBytes(request, etag, artifact.bytes);
  HttpResponse response;
  response.status = selection.status;
  if (selection.status == 416) {
    response = ProblemResponse(request, {416, "range-not-satisfiable",
                                         "the artifact has " + std::to_string(artifact.bytes) +
                                             " bytes; the range starts after them"});
    response.Set("Content-Range", "bytes */" + std::to_string(artifact.bytes));
    return response;
  }
  if (selection.status == 412) {
    return ProblemResponse(
        request, {412, "precondition-failed", "the artifact is not the one that If-Match names"});
  }
  response.Set("ETag", etag);
  response.Set("Cache-Control", "private, max-age=31536000, immutable");
  if (selection.status == 304) return response;
  response.Set("Content-Type", artifact.media_type);
  response.Set("Accept-Ranges", "bytes");
  response.Set("Content-Disposition", "attachment; filename=\"" + artifact.name + "\"");
  if (selection.status == 206) {
    response.Set("Content-Range", "bytes " + std::to_string(selection.offset) + "-" +
                                      std::to_string(selection.offset + selection.bytes - 1) + "/" +
                                      std::to_string(artifact.bytes));
  }
  response.Set("Repr-Digest", "sha-256=:" + Base64OfHex(artifact.sha256) + ":");
  response.file = FileBody{std::make_shared<UniqueFd>(std::move(open.object.fd)), selection.offset,
                           selection.bytes};
  return response;
}

HttpResponse GetArtifact(const HandlerContext& context, const HttpRequest& request) {
  Result<Job> job = FinishedJob(context, request.parameters.at(0));
  if (!job) return ProblemResponse(request, ProblemOf(job.error()));
  Result<OpenArtifact> open = context.jobs.Open(job->id, request.parameters.at(1));
  if (open) return SendArtifact(request, *std::move(open));
  const Problem problem = ProblemOf(open.error());
  if (problem.status >= 500) {
    Log(LogLevel::kError, "artifact lost", {{"job_id", job->id}, {"error", open.error().message}});
  }
  return ProblemResponse(request, problem);
}

}  // namespace

std::vector<Route> ResultRoutes(const HandlerContext& context) {
  return {
      {"GET", "/jobs/{id}/results",
       [context](const HttpRequest& request, BodySink*) { return ListResults(context, request); }},
      {"GET", "/jobs/{id}/results/{name}",
       [context](const HttpRequest& request, BodySink*) { return GetArtifact(context, request); }}};
}

}  // namespace farhorizon
