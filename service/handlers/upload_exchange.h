#pragma once

#include <memory>
#include <string_view>

#include "service/handlers/exchange.h"
#include "service/handlers/handler_context.h"
#include "service/handlers/upload_checksum.h"
#include "service/jobs/upload_writer.h"

namespace farhorizon {

/// A request whose body goes to the end of an upload. What has come of one that is broken off is
/// kept, unless it has a checksum, or makes the upload: then nobody knows where it is.
class UploadExchange : public Exchange {
 public:
  /// makes: whether the request makes the upload, too.
  UploadExchange(const HandlerContext& context, const HttpRequest& request,
                 std::unique_ptr<UploadWriter> writer, UploadChecksum checksum, bool makes);

  /// Errors: kResourceExhausted "body-too-large" beyond the upload's length; those of the writer.
  Status Take(std::string_view piece) override;
  HttpResponse Finish() override;
  void Abandon() override;

 private:
  const HandlerContext& context_;
  const HttpRequest& request_;
  std::unique_ptr<UploadWriter> writer_;
  UploadChecksum checksum_;
  bool makes_;
};

/// Sets the fields of a response that say how the upload stands.
void SetUploadFields(const Upload& upload, HttpResponse& response);
/// 201 for an upload that was just made.
HttpResponse UploadMade(const HandlerContext& context, const Upload& upload);
/// "body-too-large": the upload would have more than the `most` bytes that it may.
Error UploadTooLarge(std::int64_t most);

}  // namespace farhorizon
