#pragma once

#include <atomic>
#include <chrono>
#include <cstdint>
#include <functional>
#include <memory>
#include <stop_token>
#include <string>
#include <string_view>

#include "core/base/result.h"
#include "service/outgoing/address_rules.h"
#include "service/outgoing/outgoing_url.h"

namespace farhorizon {

struct FetchOptions {
  std::string allow;             ///< as UrlPrefixes::Read takes it; empty: nothing is fetched
  std::string private_networks;  ///< as AddressRules::Read takes it
  std::chrono::seconds time{30};
  int at_once = 4;
};

/// Fetches the files that clients link to, from where the operator allows it.
/// Threads: safe.
class Fetcher {
 public:
  /// nullptr where nothing is allowed. Errors: kInvalidArgument "invalid-config".
  static Result<std::shared_ptr<Fetcher>> Make(const FetchOptions& options);

  /// The URL of a link that may be fetched. Errors: kInvalidArgument "href-not-allowed".
  [[nodiscard]] Result<OutgoingUrl> Check(const std::string& href) const;

  /// Fetches the file, of `most_bytes` at most, piece by piece, and logs what came of it. Blocks.
  /// Errors: as SendOutgoing; kIo "href-failed" where the answer is another than 200;
  ///   kResourceExhausted where as many fetches are under way as may be.
  Status Fetch(const OutgoingUrl& url, std::int64_t most_bytes,
               const std::function<Status(std::string_view)>& take);

  /// Ends fetches that are under way, and all later ones.
  void Stop() { stop_.request_stop(); }

 private:
  Fetcher(const FetchOptions& options, UrlPrefixes allowed, AddressRules rules);

  const FetchOptions options_;
  const UrlPrefixes allowed_;
  const AddressRules rules_;
  std::atomic<int> under_way_{0};
  std::stop_source stop_;
};

}  // namespace farhorizon
