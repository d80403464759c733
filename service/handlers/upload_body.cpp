#include "service/handlers/upload_body.h"

#include <utility>

namespace farhorizon {

namespace {

constexpr std::size_t kMaxParamsBytes = 65536;

Error InvalidForm(const std::string& why) {
  return {ErrorCode::kInvalidArgument, why, "invalid-multipart"};
}

}  // namespace

Error BodyTooLarge(std::int64_t limit) {
  return {ErrorCode::kResourceExhausted,
          "the body is larger than " + std::to_string(limit) +
              " bytes, the most that is taken; send a smaller or compressed DEM",
          "body-too-large"};
}

UploadBody::UploadBody(SpoolFile spool, std::int64_t max_bytes,
                       const std::optional<std::string>& boundary)
    : spool_(std::move(spool)), max_bytes_(max_bytes) {
  if (!boundary) return;
  form_.emplace(*boundary, PartReceiver{[this](const PartHead& head) { return BeginPart(head); },
                                        [this](std::string_view data) { return TakePart(data); }});
}

Status UploadBody::Take(std::string_view piece) {
  bytes_ += static_cast<std::int64_t>(piece.size());
  if (bytes_ > max_bytes_) return BodyTooLarge(max_bytes_);
  return form_ ? form_->Feed(piece) : spool_.Write(piece);
}

Status UploadBody::Finish() const {
  if (!form_) return Ok{};
  Status ended = form_->Finish();
  if (!ended) return ended;
  if (has_dem_) return Ok{};
  return InvalidForm("the form has no part named 'dem'");
}

Status UploadBody::BeginPart(const PartHead& head) {
  const bool dem = head.name == "dem";
  if (!dem && head.name != "params") {
    return InvalidForm("the form has a part '" + head.name + "'; known are 'dem' and 'params'");
  }
  if (dem ? has_dem_ : params_.has_value()) {
    return InvalidForm("the form has the part '" + head.name + "' twice");
  }
  if (head.coding) {
    return Error{ErrorCode::kUnsupportedData,
                 "the part '" + head.name + "' of the form is encoded, as " +
                     head.coding->substr(0, 100) + "; send its bytes as they are",
                 "unsupported-media-type"};
  }
  in_dem_ = dem;
  if (dem) {
    has_dem_ = true;
    filename_ = head.filename;
  } else {
    params_.emplace();
  }
  return Ok{};
}

Status UploadBody::TakePart(std::string_view data) {
  if (in_dem_) return spool_.Write(data);
  *params_ += data;
  if (params_->size() <= kMaxParamsBytes) return Ok{};
  return InvalidForm("the part 'params' is larger than 65536 bytes");
}

}  // namespace farhorizon
