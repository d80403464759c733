// tus 1.0.0 with its extensions creation, creation-with-upload, creation-defer-length, checksum,
// expiration and termination; not concatenation. Of two requests that write to one upload the newer
// one wins, so that a client whose connection was cut goes on at once: there is no 423 Locked.
#include "service/handlers/uploads.h"

#include <memory>
#include <optional>
#include <utility>

#include "service/clock.h"
#include "service/handlers/json.h"
#include "service/handlers/problem.h"
#include "service/handlers/submit.h"
#include "service/handlers/upload_exchange.h"
#include "service/handlers/upload_fields.h"
#include "service/log.h"

namespace farhorizon {

namespace {

constexpr const char* kMediaType = "application/offset+octet-stream";
constexpr const char* kExtensions =
    "creation,creation-with-upload,creation-defer-length,checksum,expiration,termination";
constexpr std::size_t kMostTypeBytes = 100;

HttpResponse Refuse(const HttpRequest& request, const Error& error) {
  const Problem problem = ProblemOf(error);
  if (problem.status >= 500) {
    Log(LogLevel::kError, "upload refused", {{"error", error.message}});
  }
  return ProblemResponse(request, problem);
}

std::optional<HttpResponse> RefuseMedia(const HttpRequest& request) {
  const std::string* type = request.Header("content-type");
  const std::string* coding = request.Header("content-encoding");
  const bool plain = coding == nullptr || LowerCase(*coding) == "identity";
  if (plain && type != nullptr && MediaTypeIn(*type) == kMediaType) return std::nullopt;
  return ProblemResponse(
      request, {"unsupported-media-type", std::string("bytes of an upload have the Content-Type ") +
                                              kMediaType + " and no Content-Encoding"});
}

// What must be true of the length and of the body's before the body is asked for.
Status CheckLengths(const HandlerContext& context, const HttpRequest& request,
                    const Upload& upload) {
  const std::int64_t most = context.jobs.Uploads().most_bytes();
  if (upload.bytes.value_or(0) > most) return UploadTooLarge(most);
  const std::int64_t all = upload.bytes.value_or(most);
  if (upload.offset > all || request.content_length.value_or(0) > all - upload.offset) {
    return UploadTooLarge(all);
  }
  return context.jobs.CheckUploadRoom();
}

Result<Upload> ReadNewUpload(const HttpRequest& request) {
  Result<std::optional<std::int64_t>> length = ReadNewUploadLength(request);
  if (!length) return std::move(length.error());
  Result<UploadMetadata> metadata = ReadUploadMetadata(request);
  if (!metadata) return std::move(metadata.error());
  Upload upload;
  upload.owner = request.caller.owner;
  upload.client = ClientOf(request);
  upload.filename = SafeFilename(metadata->filename);
  upload.media_type = metadata->file_type.substr(0, kMostTypeBytes);
  upload.metadata = std::move(metadata->text);
  upload.bytes = *length;
  return upload;
}

// A request with nothing more to come.
class Answered : public Exchange {
 public:
  explicit Answered(HttpResponse response) : response_(std::move(response)) {}
  Status Take(std::string_view) override { return Ok{}; }
  HttpResponse Finish() override { return std::move(response_); }

 private:
  HttpResponse response_;
};

Admission MakeUpload(const HandlerContext& context, const HttpRequest& request) {
  if (auto refusal = RefuseTusVersion(request)) return *std::move(refusal);
  if (request.HasBody()) {
    if (auto refusal = RefuseMedia(request)) return *std::move(refusal);
  }
  Result<UploadChecksum> checksum = UploadChecksum::Of(request);
  if (!checksum) return Refuse(request, checksum.error());
  Result<Upload> upload = ReadNewUpload(request);
  if (!upload) return Refuse(request, upload.error());
  const Status room = CheckLengths(context, request, *upload);
  if (!room) return Refuse(request, room.error());
  UploadService& uploads = context.jobs.Uploads();
  upload = uploads.Create(*std::move(upload));
  if (!upload) return Refuse(request, upload.error());
  if (!request.HasBody()) return std::make_unique<Answered>(UploadMade(context, *upload));
  Result<std::unique_ptr<UploadWriter>> writer = uploads.Write(*upload, checksum->IsAsked());
  if (!writer) return Refuse(request, writer.error());
  return std::make_unique<UploadExchange>(context, request, *std::move(writer),
                                          *std::move(checksum), true);
}

Admission PatchUpload(const HandlerContext& context, const HttpRequest& request) {
  if (auto refusal = RefuseTusVersion(request)) return *std::move(refusal);
  if (auto refusal = RefuseMedia(request)) return *std::move(refusal);
  const Result<std::int64_t> offset = ReadUploadOffset(request);
  if (!offset) return Refuse(request, offset.error());
  const Result<std::optional<std::int64_t>> length = ReadUploadLength(request);
  if (!length) return Refuse(request, length.error());
  Result<UploadChecksum> checksum = UploadChecksum::Of(request);
  if (!checksum) return Refuse(request, checksum.error());
  Result<Upload> upload = FindUpload(context, request, request.parameters.at(0));
  if (!upload) return Refuse(request, upload.error());
  if (upload->bytes && *length && *upload->bytes != **length) {
    return Refuse(request,
                  {ErrorCode::kInvalidArgument,
                   "the Upload-Length of this upload was another before", "invalid-upload"});
  }
  if (!upload->bytes) upload->bytes = *length;
  // The row decides once more, when the turn is taken.
  if (upload->offset != *offset) return Refuse(request, UploadOffsetMismatch());
  const Status room = CheckLengths(context, request, *upload);
  if (!room) return Refuse(request, room.error());
  Result<std::unique_ptr<UploadWriter>> writer =
      context.jobs.Uploads().Write(*upload, checksum->IsAsked());
  if (!writer) return Refuse(request, writer.error());
  return std::make_unique<UploadExchange>(context, request, *std::move(writer),
                                          *std::move(checksum), false);
}

nlohmann::ordered_json UploadInfo(const HandlerContext& context, const Upload& upload) {
  nlohmann::ordered_json info = {{"id", upload.id},
                                 {"href", context.base + "/uploads/" + upload.id},
                                 {"offset", upload.offset},
                                 {"complete", upload.IsComplete()},
                                 {"filename", upload.filename},
                                 {"filetype", upload.media_type},
                                 {"created", FormatTime(upload.created_ms)},
                                 {"expires", FormatTime(upload.expires_ms)}};
  if (upload.bytes) info["length"] = *upload.bytes;
  return info;
}

// GET and HEAD. The fields are tus', for HEAD; the body is for people.
HttpResponse ShowUpload(const HandlerContext& context, const HttpRequest& request) {
  if (request.method == "HEAD") {
    if (auto refusal = RefuseTusVersion(request)) return *std::move(refusal);
  }
  const Result<Upload> upload = FindUpload(context, request, request.parameters.at(0));
  if (!upload) return Refuse(request, upload.error());
  HttpResponse response = JsonResponse(UploadInfo(context, *upload));
  response.upload_id = upload->id;
  SetUploadFields(*upload, response);
  if (upload->bytes) {
    response.Set("Upload-Length", std::to_string(*upload->bytes));
  } else {
    response.Set("Upload-Defer-Length", "1");
  }
  if (!upload->metadata.empty()) response.Set("Upload-Metadata", upload->metadata);
  return response;
}

HttpResponse RemoveUpload(const HandlerContext& context, const HttpRequest& request) {
  if (auto refusal = RefuseTusVersion(request)) return *std::move(refusal);
  const Result<Upload> upload = FindUpload(context, request, request.parameters.at(0));
  if (!upload) return Refuse(request, upload.error());
  const Status removed = context.jobs.Uploads().Remove(upload->id);
  if (!removed) return Refuse(request, removed.error());
  HttpResponse response;
  response.status = 204;
  response.upload_id = upload->id;
  return response;
}

Route OptionsRoute(const HandlerContext& context, const char* pattern, const char* methods) {
  return BodylessRoute(
      "OPTIONS", pattern,
      [context, methods](const HttpRequest&) {
        HttpResponse response = OptionsResponse(methods);
        response.Set("Tus-Version", kTusVersion);
        response.Set("Tus-Extension", kExtensions);
        response.Set("Tus-Max-Size", std::to_string(context.jobs.Uploads().most_bytes()));
        response.Set("Tus-Checksum-Algorithm", kChecksumAlgorithms);
        return response;
      },
      WaitsFor::kNothing);
}

}  // namespace

Result<Upload> FindUpload(const HandlerContext& context, const HttpRequest& request,
                          const std::string& id) {
  if (!IsJobId(id)) return NoSuchUpload();
  Result<Upload> upload = context.jobs.Uploads().Find(id);
  if (upload && !request.caller.Sees(upload->owner)) return NoSuchUpload();
  return upload;
}

std::vector<Route> UploadRoutes(const HandlerContext& context) {
  return {
      OptionsRoute(context, "/uploads", "POST, OPTIONS"),
      OptionsRoute(context, "/uploads/{id}", "GET, HEAD, PATCH, DELETE, OPTIONS"),
      {"POST", "/uploads",
       [context](const HttpRequest& request) { return MakeUpload(context, request); },
       WaitsFor::kProcess},
      {"PATCH", "/uploads/{id}",
       [context](const HttpRequest& request) { return PatchUpload(context, request); },
       // A body with a checksum is stored as a whole: who asks for a status does not wait for it.
       WaitsFor::kProcess},
      BodylessRoute("GET", "/uploads/{id}",
                    [context](const HttpRequest& request) { return ShowUpload(context, request); }),
      BodylessRoute("DELETE", "/uploads/{id}", [context](const HttpRequest& request) {
        return RemoveUpload(context, request);
      })};
}

}  // namespace farhorizon
