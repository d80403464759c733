#include "service/handlers/upload_checksum.h"

#include <algorithm>
#include <utility>

#include "core/io/base64.h"
#include "service/handlers/upload_fields.h"

namespace farhorizon {

namespace {

constexpr std::size_t kSha1Bytes = 20;
constexpr std::size_t kSha256Bytes = 32;

}  // namespace

Result<UploadChecksum> UploadChecksum::Of(const HttpRequest& request) {
  UploadChecksum checksum;
  const std::string* field = request.Header("upload-checksum");
  if (field == nullptr) return checksum;
  const std::size_t blank = std::min(field->find(' '), field->size());
  const std::string name = field->substr(0, blank);
  if (name == "sha1" || name == "sha256") checksum.sum_ = Checksum::Named(name);
  if (!checksum.sum_) {
    return InvalidUpload(std::string("Upload-Checksum must be of one of ") + kChecksumAlgorithms);
  }
  Base64Decoder decoder;
  const bool read =
      decoder.Feed(std::string_view(*field).substr(blank), checksum.expected_) && decoder.MayEnd();
  if (read && checksum.expected_.size() == (name == "sha1" ? kSha1Bytes : kSha256Bytes)) {
    return checksum;
  }
  return InvalidUpload("Upload-Checksum must be the algorithm, a blank, and the sum in base64");
}

void UploadChecksum::Add(std::string_view piece) {
  if (sum_) sum_->Add(piece);
}

Status UploadChecksum::Check() {
  if (!sum_ || sum_->Finish() == expected_) return Ok{};
  return Error{ErrorCode::kInvalidArgument,
               "the body is not the one that Upload-Checksum says, and nothing of it was kept; "
               "send it again",
               "checksum-mismatch"};
}

}  // namespace farhorizon
