#include "service/handlers/upload_exchange.h"

#include <string>
#include <utility>

#include "service/clock.h"
#include "service/handlers/problem.h"
#include "service/log.h"
#include "service/metrics.h"

namespace farhorizon {

UploadExchange::UploadExchange(const HandlerContext& context, const HttpRequest& request,
                               std::unique_ptr<UploadWriter> writer, UploadChecksum checksum,
                               bool makes)
    : context_(context),
      request_(request),
      writer_(std::move(writer)),
      checksum_(std::move(checksum)),
      makes_(makes) {}

Status UploadExchange::Take(std::string_view piece) {
  const std::int64_t most = writer_->upload().bytes.value_or(context_.jobs.Uploads().most_bytes());
  if (writer_->end() + static_cast<std::int64_t>(piece.size()) > most) return UploadTooLarge(most);
  CountUploadedBytes(static_cast<std::int64_t>(piece.size()));
  checksum_.Add(piece);
  return writer_->Write(piece);
}

HttpResponse UploadExchange::Finish() {
  Status stored = checksum_.Check();
  if (stored) stored = writer_->Store();
  if (!stored) {
    const Problem problem = ProblemOf(stored.error());
    if (problem.status >= 500) {
      Log(LogLevel::kError, "upload failed", {{"error", stored.error().message}});
    }
    if (makes_) Abandon();
    return ProblemResponse(request_, problem);
  }
  if (makes_) return UploadMade(context_, writer_->upload());
  HttpResponse response;
  response.status = 204;
  response.upload_id = writer_->upload().id;
  SetUploadFields(writer_->upload(), response);
  return response;
}

void UploadExchange::Abandon() {
  if (!makes_ && checksum_.IsAsked()) return;
  const Status done =
      makes_ ? context_.jobs.Uploads().Remove(writer_->upload().id) : writer_->Store();
  if (!done) Log(LogLevel::kInfo, "an upload is cut off", {{"error", done.error().message}});
}

void SetUploadFields(const Upload& upload, HttpResponse& response) {
  response.Set("Upload-Offset", std::to_string(upload.offset));
  response.Set("Upload-Expires", FormatHttpDate(upload.expires_ms));
}

HttpResponse UploadMade(const HandlerContext& context, const Upload& upload) {
  HttpResponse response;
  response.status = 201;
  response.upload_id = upload.id;
  response.Set("Location", context.base + "/uploads/" + upload.id);
  SetUploadFields(upload, response);
  return response;
}

Error UploadTooLarge(std::int64_t most) {
  return {ErrorCode::kResourceExhausted,
          "the upload may have " + std::to_string(most) +
              " bytes, by its Upload-Length or as the most that is taken, and this would be more",
          "body-too-large"};
}

}  // namespace farhorizon
