#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "core/base/result.h"
#include "service/handlers/multipart.h"
#include "service/jobs/spool_file.h"

namespace farhorizon {

/// The body of a submission on its way to disk: a DEM, or a multipart form with the part `dem` and
/// perhaps the part `params`. The DEM goes to a spool file, `params` to memory.
class UploadBody {
 public:
  /// boundary: that of the form; nullopt if the body is the DEM itself.
  UploadBody(SpoolFile spool, std::int64_t max_bytes, const std::optional<std::string>& boundary);
  UploadBody(const UploadBody&) = delete;
  UploadBody& operator=(const UploadBody&) = delete;

  /// Errors: kResourceExhausted "body-too-large"; kInvalidArgument "invalid-multipart";
  ///   kUnsupportedData "unsupported-media-type" where a part is encoded; those of the spool file.
  Status Take(std::string_view piece);
  /// Checks, after the last piece, that a form has its end and its DEM.
  /// Errors: kInvalidArgument "invalid-multipart".
  Status Finish() const;

  [[nodiscard]] const SpoolFile& spool() const { return spool_; }
  /// The file name that the form gives its DEM.
  [[nodiscard]] const std::optional<std::string>& filename() const { return filename_; }
  /// The form's part `params`, as sent.
  [[nodiscard]] const std::optional<std::string>& params() const { return params_; }

 private:
  Status BeginPart(const PartHead& head);
  Status TakePart(std::string_view data);

  SpoolFile spool_;
  std::int64_t max_bytes_;
  std::int64_t bytes_ = 0;
  std::optional<MultipartParser> form_;
  bool in_dem_ = false;
  bool has_dem_ = false;
  std::optional<std::string> filename_;
  std::optional<std::string> params_;
};

/// "body-too-large": the body has more than `limit` bytes.
Error BodyTooLarge(std::int64_t limit);

}  // namespace farhorizon
