// POST /jobs. In the order of what is cheap: media type, length, room, parameters; then the body;
// then its first bytes, a look by a worker, and the store.
#include "service/handlers/submit.h"

#include <utility>

#include "core/pipeline/build.h"
#include "service/handlers/json.h"
#include "service/handlers/multipart.h"
#include "service/handlers/problem.h"
#include "service/handlers/raster_sniff.h"
#include "service/handlers/status_info.h"
#include "service/log.h"

namespace farhorizon {

namespace {

constexpr const char* kAccepted = "image/tiff, application/octet-stream, multipart/form-data";
constexpr std::size_t kLargestParams = 65536;
constexpr std::size_t kLongestKey = 256;

Error TooLarge(std::int64_t limit) {
  return {ErrorCode::kResourceExhausted,
          "the body is larger than " + std::to_string(limit) +
              " bytes, the most that is taken; send a smaller or compressed DEM",
          "body-too-large"};
}

/// An upload of either form, on its way to disk.
class UploadSink : public BodySink {
 public:
  UploadSink(SpoolFile spool, std::int64_t max_bytes)
      : spool_(std::move(spool)), max_bytes_(max_bytes) {}

  /// The body is a form.
  void ReadForm(const std::string& boundary) {
    form_.emplace(boundary, PartReceiver{[this](const PartHead& head) { return BeginPart(head); },
                                         [this](std::string_view data) { return Take(data); }});
  }

  Status Write(std::string_view piece) override {
    bytes_ += static_cast<std::int64_t>(piece.size());
    if (bytes_ > max_bytes_) return TooLarge(max_bytes_);
    return form_ ? form_->Feed(piece) : spool_.Write(piece);
  }

  /// All has come; is it whole?
  Status Finish() {
    if (!form_) return Done{};
    Status ended = form_->Finish();
    if (!ended) return ended;
    if (has_dem_) return Done{};
    return Error{ErrorCode::kInvalidArgument, "the form has no part named 'dem'",
                 "invalid-multipart"};
  }

  [[nodiscard]] const SpoolFile& spool() const { return spool_; }
  [[nodiscard]] const std::optional<std::string>& filename() const { return filename_; }
  [[nodiscard]] const std::optional<std::string>& params() const { return params_; }

 private:
  Status BeginPart(const PartHead& head) {
    const bool dem = head.name == "dem";
    if (!dem && head.name != "params") {
      return Error{ErrorCode::kInvalidArgument,
                   "the form has a part '" + head.name + "'; known are 'dem' and 'params'",
                   "invalid-multipart"};
    }
    if (dem ? has_dem_ : params_.has_value()) {
      return Error{ErrorCode::kInvalidArgument, "the form has the part '" + head.name + "' twice",
                   "invalid-multipart"};
    }
    in_dem_ = dem;
    if (dem) {
      has_dem_ = true;
      filename_ = head.filename;
    } else {
      params_.emplace();
    }
    return Done{};
  }

  Status Take(std::string_view data) {
    if (in_dem_) return spool_.Write(data);
    *params_ += data;
    if (params_->size() <= kLargestParams) return Done{};
    return Error{ErrorCode::kInvalidArgument, "the part 'params' is larger than 65536 bytes",
                 "invalid-multipart"};
  }

  SpoolFile spool_;
  std::int64_t max_bytes_;
  std::int64_t bytes_ = 0;
  std::optional<MultipartParser> form_;
  bool in_dem_ = false;
  bool has_dem_ = false;
  std::optional<std::string> filename_;
  std::optional<std::string> params_;
};

/// The query's parameters and the name taken out of them.
struct Wishes {
  Parameters parameters;
  std::optional<std::string> filename;
};

Result<Wishes> WishesOf(const HttpRequest& request) {
  std::optional<Parameters> query = DecodeQuery(request.query);
  if (!query) {
    return Error{
        ErrorCode::kInvalidArgument,
        "the query cannot be read: a name is empty or stands twice, or an escape is broken",
        "invalid-parameter"};
  }
  Wishes wishes{*std::move(query), {}};
  const auto name = wishes.parameters.find("filename");
  if (name != wishes.parameters.end()) {
    wishes.filename = name->second;
    wishes.parameters.erase(name);
  }
  return wishes;
}

Status CheckParameters(const Parameters& parameters) {
  Result<BuildOptions> options = ParseOptions(parameters);
  if (!options) return std::move(options.error());
  return CheckOptions(*options);
}

/// The draft wants a quoted string; a bare one is taken too.
Result<std::optional<std::string>> IdempotencyKey(const HttpRequest& request) {
  const std::string* field = request.Header("idempotency-key");
  if (field == nullptr) return std::optional<std::string>();
  std::string_view key = Trimmed(*field);
  if (key.size() >= 2 && key.front() == '"' && key.back() == '"') {
    key = key.substr(1, key.size() - 2);
  }
  if (key.empty() || key.size() > kLongestKey) {
    return Error{ErrorCode::kInvalidArgument, "the Idempotency-Key must have 1 to 256 characters",
                 "invalid-idempotency-key"};
  }
  return std::optional<std::string>(key);
}

Status CheckHead(const HandlerContext& context, const HttpRequest& request) {
  if (request.content_length.value_or(0) > context.max_body_bytes) {
    return TooLarge(context.max_body_bytes);
  }
  Result<std::optional<std::string>> key = IdempotencyKey(request);
  if (!key) return std::move(key.error());
  Result<Wishes> wishes = WishesOf(request);
  if (!wishes) return std::move(wishes.error());
  Status parameters = CheckParameters(wishes->parameters);
  if (!parameters) return parameters;
  return context.jobs.CheckRoom();
}

Admission AdmitSubmission(const HandlerContext& context, const HttpRequest& request) {
  Admission admission;
  const std::string* type = request.Header("content-type");
  const std::string media = type != nullptr ? MediaTypeIn(*type) : "";
  const std::optional<std::string> boundary =
      type != nullptr ? MultipartBoundary(*type) : std::nullopt;
  if (media == "multipart/form-data" && !boundary) {
    admission.answer = ProblemResponse(
        request, {400, "invalid-multipart", "the Content-Type has no boundary that can be used"});
    return admission;
  }
  if (!boundary && media != "image/tiff" && media != "application/octet-stream") {
    admission.answer =
        ProblemResponse(request, {415, "unsupported-media-type",
                                  std::string("send the DEM with a Content-Type of ") + kAccepted});
    admission.answer->Set("Accept-Post", kAccepted);
    return admission;
  }
  Status head = CheckHead(context, request);
  if (!head) {
    admission.answer = ProblemResponse(request, ProblemOf(head.error()));
    return admission;
  }
  Result<SpoolFile> spool = context.jobs.NewSpoolFile();
  if (!spool) {
    Log(LogLevel::kError, "cannot spool", {{"error", spool.error().message}});
    admission.answer = ProblemResponse(request, ProblemOf(spool.error()));
    return admission;
  }
  auto sink = std::make_unique<UploadSink>(*std::move(spool), context.max_body_bytes);
  if (boundary) sink->ReadForm(*boundary);
  admission.sink = std::move(sink);
  return admission;
}

/// What the whole request asks for: query and form joined.
Result<Submission> SubmissionOf(const HttpRequest& request, const UploadSink& upload) {
  Result<Wishes> wishes = WishesOf(request);
  if (!wishes) return std::move(wishes.error());
  if (upload.params()) {
    Result<Parameters> form = ParametersOfJson(*upload.params());
    if (!form) return std::move(form.error());
    for (const auto& [name, value] : *form) {
      if (wishes->parameters.emplace(name, value).second) continue;
      return Error{ErrorCode::kInvalidArgument,
                   "the parameter " + name + " stands in the query and in the form",
                   "invalid-parameter"};
    }
    Status parameters = CheckParameters(wishes->parameters);
    if (!parameters) return std::move(parameters.error());
  }
  Result<std::optional<std::string>> key = IdempotencyKey(request);
  if (!key) return std::move(key.error());
  const std::string name = wishes->filename.value_or(upload.filename().value_or("dem"));
  return Submission{SafeFilename(name), wishes->parameters, *key};
}

Result<Job> Submit(const HandlerContext& context, const HttpRequest& request, UploadSink& upload) {
  Status whole = upload.Finish();
  if (!whole) return std::move(whole.error());
  Result<Submission> submission = SubmissionOf(request, upload);
  if (!submission) return std::move(submission.error());
  const SpoolFile& spool = upload.spool();
  if (!LooksLikeRaster(spool.beginning(), spool.bytes(), submission->filename)) {
    return Error{ErrorCode::kUnsupportedData,
                 spool.bytes() == 0
                     ? "the DEM has no bytes"
                     : "the DEM is of no format that is read: GeoTIFF, Arc/Info ASCII Grid, SRTM "
                       "HGT (with its name, as ?filename=N46E007.hgt), DTED, USGS DEM",
                 "not-a-raster"};
  }
  Status readable = context.jobs.Probe(spool, *submission);
  if (!readable) return std::move(readable.error());
  return context.jobs.Submit(spool, *submission);
}

HttpResponse HandleSubmission(const HandlerContext& context, const HttpRequest& request,
                              BodySink* sink) {
  Result<Job> job = Submit(context, request, dynamic_cast<UploadSink&>(*sink));
  if (!job) {
    const Problem problem = ProblemOf(job.error());
    if (problem.status >= 500) {
      Log(LogLevel::kError, "submission failed", {{"error", job.error().message}});
    }
    return ProblemResponse(request, problem);
  }
  HttpResponse response;
  response.status = 201;
  response.Set("Location", context.base + "/jobs/" + job->id);
  response.Set("Retry-After", "1");
  response.Set("Content-Type", "application/json");
  response.Set("Cache-Control", "no-store");
  response.body = DumpJson(StatusInfo(*job, context.base));
  return response;
}

/// A number or a text as a parameter's text.
std::optional<std::string> ScalarText(const nlohmann::json& value) {
  if (value.is_string()) return value.get<std::string>();
  if (value.is_number() || value.is_boolean()) return value.dump();
  return std::nullopt;
}

}  // namespace

Result<Parameters> ParametersOfJson(const std::string& text) {
  Result<nlohmann::json> document = ParseClientJson(text);
  if (!document) return std::move(document.error());
  const auto invalid = [](const std::string& what) {
    return Error{ErrorCode::kInvalidArgument, what, "invalid-parameter"};
  };
  if (!document->is_object()) return invalid("the parameters must be a JSON object");
  Parameters parameters;
  for (const auto& [name, value] : document->items()) {
    std::optional<std::string> joined = ScalarText(value);
    if (value.is_array()) {
      joined.emplace();
      for (const auto& element : value) {
        const std::optional<std::string> part = ScalarText(element);
        if (!part) return invalid("the parameter " + name + " must list numbers or texts");
        *joined += (joined->empty() ? "" : ",") + *part;
      }
    }
    if (!joined) return invalid("the parameter " + name + " must be a number, a text or a list");
    parameters.emplace(name, *joined);
  }
  return parameters;
}

Route SubmitRoute(const HandlerContext& context) {
  return {"POST", "/jobs",
          [context](const HttpRequest& request, BodySink* sink) {
            return HandleSubmission(context, request, sink);
          },
          [context](const HttpRequest& request) { return AdmitSubmission(context, request); }};
}

}  // namespace farhorizon
