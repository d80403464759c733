#include "service/outgoing/callback_rules.h"

#include <utility>

namespace farhorizon {

Result<std::shared_ptr<const CallbackRules>> CallbackRules::Make(const CallbackOptions& options) {
  Result<UrlPrefixes> allowed = UrlPrefixes::Read(options.allow, "callbacks.allow");
  if (!allowed) return std::move(allowed.error());
  Result<AddressRules> addresses =
      AddressRules::Read(options.private_networks, "callbacks.allowPrivateAddresses");
  if (!addresses) return std::move(addresses.error());
  if (allowed->empty()) return std::shared_ptr<const CallbackRules>();
  Result<WebhookSecrets> secrets = WebhookSecrets::Open(options.secret_file);
  if (!secrets) return std::move(secrets.error());
  return std::shared_ptr<const CallbackRules>(
      new CallbackRules(*std::move(allowed), *std::move(addresses), *std::move(secrets)));
}

CallbackRules::CallbackRules(UrlPrefixes allowed, AddressRules addresses, WebhookSecrets secrets)
    : allowed_(std::move(allowed)),
      addresses_(std::move(addresses)),
      secrets_(std::move(secrets)) {}

Result<OutgoingUrl> CallbackRules::Check(const std::string& url) const {
  Result<OutgoingUrl> read = ReadOutgoingUrl(url);
  if (read && allowed_.Have(*read)) return read;
  const std::string why =
      read ? "no beginning of URLs in callbacks.allow of the service's configuration is that of "
             "the call to " +
                 read->Origin()
           : read.error().message;
  return Error{ErrorCode::kInvalidArgument, why, "callback-not-allowed"};
}

}  // namespace farhorizon
