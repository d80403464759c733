#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace farhorizon {

/// Tickets for links that a browser follows by itself, without the header that has a key: for the
/// results of one job, a minute long. A ticket is signed with a secret of this process; it has the
/// id of the key it was made with, not the key.
/// Threads: safe.
class LinkTickets {
 public:
  static constexpr std::int64_t kLifetimeMs = 60'000;

  /// Makes the secret.
  LinkTickets();

  /// A ticket for the results of `job_id` that is good until `expires_ms`.
  [[nodiscard]] std::string Make(const std::string& key_id, const std::string& job_id,
                                 std::int64_t expires_ms) const;
  /// The id of the key that a ticket for this job was made with; nullopt for a text that is none,
  /// or has expired.
  [[nodiscard]] std::optional<std::string> KeyOf(std::string_view ticket, const std::string& job_id,
                                                 std::int64_t now_ms) const;

 private:
  std::string secret_;
};

}  // namespace farhorizon
