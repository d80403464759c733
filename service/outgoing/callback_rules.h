#pragma once

#include <chrono>
#include <memory>
#include <string>

#include "core/base/result.h"
#include "service/outgoing/address_rules.h"
#include "service/outgoing/outgoing_url.h"
#include "service/outgoing/webhook_secrets.h"

namespace farhorizon {

struct CallbackOptions {
  std::string allow;             ///< as UrlPrefixes::Read takes it; empty: nobody is called
  std::string private_networks;  ///< as AddressRules::Read takes it
  std::string secret_file;       ///< as WebhookSecrets::Open takes it
  std::chrono::seconds retry_time{3600};
  int at_once = 4;
};

/// Whom the service calls, and how it signs what it says.
/// Threads: safe.
class CallbackRules {
 public:
  /// nullptr where nobody may be called. Errors: kInvalidArgument "invalid-config", also for a file
  ///   of secrets that is missing or cannot be used.
  static Result<std::shared_ptr<const CallbackRules>> Make(const CallbackOptions& options);

  /// The URL, if it may be called. Errors: kInvalidArgument "callback-not-allowed".
  [[nodiscard]] Result<OutgoingUrl> Check(const std::string& url) const;

  [[nodiscard]] const AddressRules& addresses() const { return addresses_; }
  [[nodiscard]] const WebhookSecrets& secrets() const { return secrets_; }

 private:
  CallbackRules(UrlPrefixes allowed, AddressRules addresses, WebhookSecrets secrets);

  UrlPrefixes allowed_;
  AddressRules addresses_;
  WebhookSecrets secrets_;
};

}  // namespace farhorizon
