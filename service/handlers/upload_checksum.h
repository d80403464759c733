#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "core/base/result.h"
#include "core/io/checksum.h"
#include "service/handlers/http_message.h"

namespace farhorizon {

/// The algorithms of Upload-Checksum that are known, as Tus-Checksum-Algorithm lists them.
inline constexpr const char* kChecksumAlgorithms = "sha1,sha256";

/// Holds the body of a request to the sum that its Upload-Checksum says [Tus].
class UploadChecksum {
 public:
  /// Errors: kInvalidArgument "invalid-upload" where the field cannot be read, or names another
  ///   algorithm.
  static Result<UploadChecksum> Of(const HttpRequest& request);

  /// Whether the head has the field.
  [[nodiscard]] bool IsAsked() const { return sum_.has_value(); }
  void Add(std::string_view piece);
  /// Errors: kInvalidArgument "checksum-mismatch". Requires: called once, after the last piece.
  Status Check();

 private:
  std::string expected_;
  std::optional<Checksum> sum_;
};

}  // namespace farhorizon
