#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <variant>

#include "core/base/result.h"
#include "service/auth/auth_options.h"
#include "service/auth/key_meter.h"
#include "service/auth/key_ring.h"
#include "service/auth/link_tickets.h"
#include "service/handlers/http_message.h"
#include "service/handlers/problem.h"
#include "service/handlers/router.h"

namespace farhorizon {

/// Who may ask for what, from the head of a request alone.
/// Threads: safe.
class KeyGate {
 public:
  /// data: the data folder. on_loopback: whether the service listens where this machine alone
  /// reaches it.
  /// Errors: kInvalidArgument "invalid-config", with the remedy, where keys have to be asked for
  ///   and there is none; kIo where the file of keys cannot be read.
  static Result<std::shared_ptr<KeyGate>> Open(const AuthOptions& options,
                                               const std::filesystem::path& data, bool on_loopback);

  /// Whether keys are asked for. On loopback the first key that is added makes that so.
  [[nodiscard]] bool AsksForKeys() const;

  /// Sets request.caller, or returns the response that refuses the request: 401, 403, 429. A key is
  /// taken in the field Authorization alone, a ticket in the query of a GET of a result or of a
  /// job's events.
  /// route: as Router::Find gives it; a path or a method without a route needs any key, so that
  /// strangers do not learn what there is.
  [[nodiscard]] std::optional<HttpResponse> Admit(HttpRequest& request, const Route* route);

  /// Whether who was admitted still would be, as to the key.
  [[nodiscard]] bool StillGood(const Caller& caller) const;

  /// Counts the bytes of a body that has come in.
  void CountUpload(const HttpRequest& request, std::int64_t bytes);

  /// A ticket for links to the results of the job; see LinkTickets.
  [[nodiscard]] std::string MakeTicket(const Caller& caller, const std::string& job_id,
                                       std::int64_t expires_ms) const {
    return tickets_.Make(caller.key_id, job_id, expires_ms);
  }

  [[nodiscard]] std::int64_t CountKeys() const;

 private:
  KeyGate(const AuthOptions& options, bool on_loopback, std::shared_ptr<KeyRing> keys)
      : options_(options),
        on_loopback_(on_loopback),
        keys_(std::move(keys)),
        meter_(options.bounds) {}

  [[nodiscard]] std::optional<Scope> Needed(const Route& route) const;
  // The key that the request comes with; the response that refuses it.
  std::variant<ApiKey, HttpResponse> Identify(HttpRequest& request) const;

  const AuthOptions options_;
  const bool on_loopback_;
  std::shared_ptr<KeyRing> keys_;
  KeyMeter meter_;
  LinkTickets tickets_;
};

}  // namespace farhorizon
