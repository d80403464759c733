#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/result.h"

namespace farhorizon {

/// The secrets by which receivers of callbacks know the service, as Standard Webhooks has them
/// [Standard Webhooks]: a file with one "whsec_BASE64" a line, of 24 to 64 bytes each. With several
/// every message has the signature of each, so that receivers can change from one to the other.
/// Threads: safe.
class WebhookSecrets {
 public:
  /// Errors: kInvalidArgument "invalid-config", with the remedy; no text of a secret.
  static Result<WebhookSecrets> Open(const std::string& file);

  /// The field webhook-signature of a message: "v1,BASE64 v1,BASE64". By the secrets that the file
  /// has now; by those of the start where it cannot be read.
  [[nodiscard]] std::string Sign(std::string_view id, std::int64_t unix_seconds,
                                 std::string_view body) const;

 private:
  std::string file_;
  std::vector<std::string> secrets_;  // at the start
};

}  // namespace farhorizon
