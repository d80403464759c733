#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "core/base/result.h"
#include "core/io/sha256.h"
#include "service/handlers/http_message.h"

namespace farhorizon {

/// Holds a body to the SHA-256 that its Content-Digest says [RFC 9530]. Other algorithms are passed
/// over, as section 5 allows, and so is a head without the field.
class ContentDigest {
 public:
  /// Errors: kInvalidArgument "digest-mismatch" where the field cannot be read.
  static Result<ContentDigest> Of(const HttpRequest& request);

  void Add(std::string_view piece);
  /// Errors: kInvalidArgument "digest-mismatch". Requires: called once, after the last piece.
  Status Check();

 private:
  std::optional<std::string> expected_;  // in base64
  std::optional<Sha256> hash_;
};

}  // namespace farhorizon
