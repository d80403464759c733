// Execute requests of OGC API - Processes, in the order of checks of a submission: the head, then
// the body to disk, then what it says, then what it links to. The DEM in base64 goes to its spool
// file as it comes in, decoded; the rest of the JSON is small.
#include "service/handlers/execute.h"

#include <algorithm>
#include <chrono>
#include <memory>
#include <optional>
#include <utility>
#include <variant>

#include "core/io/base64.h"
#include "service/clock.h"
#include "service/handlers/asked_outputs.h"
#include "service/handlers/content_digest.h"
#include "service/handlers/echo_inputs.h"
#include "service/handlers/execute_request.h"
#include "service/handlers/input_link.h"
#include "service/handlers/json_parameters.h"
#include "service/handlers/json_sieve.h"
#include "service/handlers/linked_input.h"
#include "service/handlers/preferences.h"
#include "service/handlers/problem.h"
#include "service/handlers/processes.h"
#include "service/handlers/result_answer.h"
#include "service/handlers/results.h"
#include "service/handlers/submit.h"
#include "service/handlers/upload_body.h"
#include "service/handlers/upload_media.h"
#include "service/metrics.h"

namespace farhorizon {

namespace {

using nlohmann::json;

// Of the JSON beside the DEM; all that an echo may be sent.
constexpr std::size_t kMostRest = std::size_t{1} << 20U;
constexpr std::chrono::milliseconds kLook{20};

// What an echo needs: a process of this program that does next to nothing.
constexpr JobCost kEchoCost{std::int64_t{1} << 27U, 1};

// The body's DEM, or nothing, and the rest of it.
struct ExecutionBody {
  ExecutionBody(SpoolFile file, std::int64_t most)
      : spool(std::move(file)),
        most_bytes(most),
        sieve(
            {"inputs", "dem"}, [this](std::string_view text) { return TakeDem(text); }, kMostRest) {
  }
  ExecutionBody(const ExecutionBody&) = delete;
  ExecutionBody& operator=(const ExecutionBody&) = delete;

  Status Take(std::string_view piece) {
    bytes += static_cast<std::int64_t>(piece.size());
    if (bytes > most_bytes) return BodyTooLarge(most_bytes);
    return sieve.Feed(piece);
  }
  Status TakeDem(std::string_view text) {
    decoded.clear();
    if (!decoder.Feed(text, decoded)) return InvalidParameter("the input dem is no base64");
    return spool.Write(decoded);
  }

  SpoolFile spool;
  std::int64_t most_bytes;
  std::int64_t bytes = 0;
  Base64Decoder decoder;
  std::string decoded;  // of one piece
  JsonSieve sieve;
};

// Checks what the input `dem` says of its format.
Status CheckDemMedia(const std::string& media_type) {
  if (IsDemMediaType(MediaTypeIn(media_type))) return Ok{};
  return Error{ErrorCode::kUnsupportedData,
               "the input dem says that it is " + media_type.substr(0, 100) +
                   "; send it as image/tiff or application/octet-stream",
               "unsupported-media-type"};
}

// Checks what the input `dem`, which is a value, says of itself.
Status CheckDemInput(const json& inputs, const ExecutionBody& body) {
  Result<GivenInput> dem = ReadInput("dem", inputs["dem"]);
  if (!dem) return std::move(dem.error());
  if (!body.sieve.found() || !body.decoder.MayEnd()) {
    return InvalidParameter(
        "the input dem must be one text in base64, or an object with it as value");
  }
  if (!dem->encoding.empty() && dem->encoding != "base64") {
    return InvalidParameter("the encoding of the input dem must be base64");
  }
  return CheckDemMedia(dem->media_type);
}

// The inputs beside the DEM, as parameters of a job.
Result<Parameters> ParametersOfInputs(const json& inputs) {
  json values = json::object();
  for (const auto& [name, given] : inputs.items()) {
    if (name == "dem") continue;
    Result<json> value = ReadValue(name, given);
    if (!value) return std::move(value.error());
    values[name] = *std::move(value);
  }
  return ParametersOf(values);
}

// Where the DEM comes from; neither where it is in the body.
struct DemOrigin {
  std::optional<Upload> upload;   // of this service
  std::optional<InputLink> link;  // to elsewhere
};

class ExecuteExchange : public Exchange {
 public:
  ExecuteExchange(const HandlerContext& context, const HttpRequest& request, std::string process,
                  SpoolFile spool, std::optional<std::string> key, ContentDigest digest)
      : context_(context),
        request_(request),
        process_(std::move(process)),
        body_(std::move(spool), context.max_body_bytes),
        key_(std::move(key)),
        digest_(std::move(digest)) {}

  Status Take(std::string_view piece) override {
    CountUploadedBytes(static_cast<std::int64_t>(piece.size()));
    digest_.Add(piece);
    return body_.Take(piece);
  }
  HttpResponse Finish() override;

 private:
  Result<Job> Submit();
  Result<DemOrigin> TakeDem(const json& inputs);
  Result<Job> SubmitTerrain(const ExecuteRequest& asked);
  Result<Job> SubmitEcho(const ExecuteRequest& asked);
  /// The job's results, once it has ended; nullopt if it takes too long.
  std::optional<HttpResponse> WaitForResults(const std::string& id, std::int64_t seconds);

  const HandlerContext& context_;
  const HttpRequest& request_;
  std::string process_;
  ExecutionBody body_;
  std::optional<std::string> key_;
  ContentDigest digest_;
};

Result<DemOrigin> ExecuteExchange::TakeDem(const json& inputs) {
  if (!inputs.contains("dem")) return InvalidParameter("the input dem is missing");
  Result<std::optional<InputLink>> link = ReadLink(inputs["dem"]);
  if (!link) return std::move(link.error());
  Status fits = *link ? CheckDemMedia((*link)->type) : CheckDemInput(inputs, body_);
  if (!fits) return std::move(fits.error());
  DemOrigin origin;
  if (!*link) return origin;
  const std::optional<std::string> id = OwnUploadOf(context_, request_, (*link)->href);
  if (!id) {
    origin.link = **std::move(link);
    return origin;
  }
  Result<Upload> upload = FindWholeUpload(context_, request_, *id);
  if (!upload) return std::move(upload.error());
  origin.upload = *std::move(upload);
  return origin;
}

Result<Job> ExecuteExchange::SubmitTerrain(const ExecuteRequest& asked) {
  Result<DemOrigin> origin = TakeDem(asked.inputs);
  if (!origin) return std::move(origin.error());
  Result<Parameters> parameters = ParametersOfInputs(asked.inputs);
  if (!parameters) return std::move(parameters.error());
  const std::optional<Upload>& upload = origin->upload;
  std::string filename = upload ? upload->filename : "";
  if (const auto name = parameters->find("filename"); name != parameters->end()) {
    filename = name->second;
    parameters->erase(name);
  }
  Result<Wishes> wishes = ReadWishes(*std::move(parameters), context_.terms);
  if (!wishes) return std::move(wishes.error());
  if (Status made = CheckOutputsOf(asked.wishes, wishes->options); !made) {
    return std::move(made.error());
  }
  Submission submission{.filename = SafeFilename(filename),
                        .parameters = std::move(wishes->parameters),
                        .idempotency_key = std::move(key_),
                        .client = ClientOf(request_),
                        .terms = wishes->terms,
                        .options = std::move(wishes->options),
                        .answer = WriteResultWishes(asked.wishes),
                        .owner = request_.caller.owner,
                        .upload = upload ? upload->id : "",
                        .subscriber = asked.subscriber};
  if (origin->link) {
    return SubmitLinked(context_, request_, *origin->link, body_.spool, std::move(submission));
  }
  if (upload) {
    Status copied = context_.jobs.Uploads().CopyTo(*upload, body_.spool);
    if (!copied) return std::move(copied.error());
  }
  return SubmitUpload(context_, body_.spool, std::move(submission));
}

Result<Job> ExecuteExchange::SubmitEcho(const ExecuteRequest& asked) {
  Result<std::string> task = EchoTaskOf(asked.inputs);
  if (!task) return std::move(task.error());
  if (Status written = body_.spool.Write(*task); !written) return std::move(written.error());
  return context_.jobs.Submit(body_.spool, {.filename = "echo.json",
                                            .parameters = {},
                                            .idempotency_key = std::move(key_),
                                            .client = ClientOf(request_),
                                            .cost = kEchoCost,
                                            .process = kEchoProcess,
                                            .answer = WriteResultWishes(asked.wishes),
                                            .owner = request_.caller.owner,
                                            .subscriber = asked.subscriber});
}

Result<Job> ExecuteExchange::Submit() {
  Status intact = digest_.Check();
  if (!intact) return std::move(intact.error());
  Result<ExecuteRequest> asked = ReadExecuteRequest(context_, body_.sieve.rest(), process_);
  if (!asked) return std::move(asked.error());
  process_ = asked->process;
  return process_ == kEchoProcess ? SubmitEcho(*asked) : SubmitTerrain(*asked);
}

std::optional<HttpResponse> ExecuteExchange::WaitForResults(const std::string& id,
                                                            std::int64_t seconds) {
  // What a request for the results would say of ranges and of what the client has is not said here.
  HttpRequest plain = request_;
  std::erase_if(plain.headers, [](const auto& field) { return field.first != "accept"; });
  for (const std::int64_t end = NowMs() + seconds * 1000;;) {
    const Result<Job> job = context_.jobs.Find(id);
    if (!job) return ProblemResponse(plain, ProblemOf(job.error()));
    if (job->state == JobState::kSuccessful) return AnswerResults(context_, plain, *job);
    if (job->failure) return ProblemResponse(plain, ProblemOf(*job->failure));
    if (IsTerminal(job->state)) return ProblemResponse(plain, ProblemOf(NoResults()));
    if (NowMs() >= end) return std::nullopt;
    Pause(kLook, {});
  }
}

HttpResponse ExecuteExchange::Finish() {
  const Result<Job> job = Submit();
  const Preferences prefers = PreferencesOf(request_);
  const bool at_once = job && process_ == kEchoProcess && !prefers.respond_async;
  if (at_once) {
    const std::int64_t seconds =
        std::min(prefers.wait_seconds.value_or(kMostWaitSeconds), kMostWaitSeconds);
    if (std::optional<HttpResponse> results = WaitForResults(job->id, seconds)) {
      results->job_id = job->id;
      return *std::move(results);
    }
  }
  HttpResponse response = SubmittedResponse(context_, request_, job);
  if (job && prefers.respond_async) response.Set("Preference-Applied", "respond-async");
  return response;
}

}  // namespace

Admission BeginExecution(const HandlerContext& context, const HttpRequest& request,
                         const std::string& process) {
  if (!request.query.empty()) {
    return ProblemResponse(request, {"invalid-parameter",
                                     "beside JSON there are no parameters in the query; "
                                     "they are inputs of the execute request"});
  }
  if (request.content_length.value_or(0) > context.max_body_bytes) {
    return ProblemResponse(request, ProblemOf(BodyTooLarge(context.max_body_bytes)));
  }
  Result<std::optional<std::string>> key = ReadIdempotencyKey(request);
  if (!key) return ProblemResponse(request, ProblemOf(key.error()));
  Result<ContentDigest> digest = ContentDigest::Of(request);
  if (!digest) return ProblemResponse(request, ProblemOf(digest.error()));
  Result<SpoolFile> spool = SpoolForJob(context, request);
  if (!spool) return ProblemResponse(request, ProblemOf(spool.error()));
  return std::make_unique<ExecuteExchange>(context, request, process, *std::move(spool),
                                           *std::move(key), *std::move(digest));
}

Route ExecutionRoute(const HandlerContext& context) {
  const auto begin = [context](const HttpRequest& request) -> Admission {
    const std::string& process = request.parameters.at(0);
    if (!IsOffered(context, process)) {
      return ProblemResponse(request, ProblemOf(NoSuchProcess(process)));
    }
    std::variant<UploadMedia, HttpResponse> media = ReadExecutionMedia(request);
    if (auto* refusal = std::get_if<HttpResponse>(&media)) return std::move(*refusal);
    return BeginExecution(context, request, process);
  };
  return {"POST", "/processes/{id}/execution", begin, WaitsFor::kProcess};
}

}  // namespace farhorizon
