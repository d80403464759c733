#include "service/jobs/sql_callbacks.h"

#include <algorithm>
#include <array>
#include <utility>

namespace farhorizon {

namespace {

// No call is put off for longer: a later time was written before the clock went back.
constexpr std::int64_t kLongestCallDelayMs = std::int64_t{2} * 3600 * 1000;

constexpr const char* kThisClaim =
    " WHERE job_id = ? AND event = ? AND state = 'due' AND attempts = ?";

// The time that leases of calls go by, as an expression.
std::string Now(const SqlDatabase& database, std::int64_t now_ms) {
  const std::string& clock = database.dialect().clock_ms;
  return clock.empty() ? std::to_string(now_ms) : clock;
}

bool Change(Statement& update, const DueCallback& callback) {
  update.Bind(callback.job_id).Bind(std::string(NameOf(callback.event))).Bind(callback.attempt);
  return update.Run() == 1;
}

}  // namespace

void InsertSubscriber(const SqlDatabase& database, const std::string& id, const Subscriber& whom) {
  const std::array<std::pair<CallbackEvent, const std::string*>, 3> all = {
      std::pair{CallbackEvent::kInProgress, &whom.in_progress_uri},
      std::pair{CallbackEvent::kSuccess, &whom.success_uri},
      std::pair{CallbackEvent::kFailure, &whom.failed_uri}};
  for (const auto& [event, url] : all) {
    if (url->empty()) continue;
    Statement insert(database, "INSERT INTO callbacks (job_id, event, url) VALUES (?, ?, ?)");
    insert.Bind(id).Bind(std::string(NameOf(event))).Bind(*url).Run();
  }
}

Subscriber SelectSubscriber(const SqlDatabase& database, const std::string& id) {
  Statement rows(database, "SELECT event, url FROM callbacks WHERE job_id = ?");
  rows.Bind(id);
  Subscriber whom;
  while (rows.Step()) {
    const std::string event = rows.Text(0);
    if (event == NameOf(CallbackEvent::kInProgress)) whom.in_progress_uri = rows.Text(1);
    if (event == NameOf(CallbackEvent::kSuccess)) whom.success_uri = rows.Text(1);
    if (event == NameOf(CallbackEvent::kFailure)) whom.failed_uri = rows.Text(1);
  }
  return whom;
}

std::optional<DueCallback> ClaimCallback(SqlDatabase& database, std::chrono::milliseconds lease,
                                         std::int64_t now_ms) {
  const std::string now = Now(database, now_ms);
  const std::string due = " FROM callbacks WHERE state = 'due' AND (due_ms <= " + now +
                          " OR due_ms > " + now + " + " + std::to_string(kLongestCallDelayMs) +
                          ") ORDER BY due_ms LIMIT 1";
  // Without a transaction where there is nothing to do, as nearly always.
  if (!Statement(database, "SELECT 1" + due).Step()) return std::nullopt;
  Transaction transaction(database);
  std::optional<DueCallback> claimed;
  {
    Statement next(database, "SELECT job_id, event, url, attempts, " + now + " - since_ms" + due +
                                 database.dialect().lock_free);
    if (!next.Step()) return std::nullopt;
    const auto* const event =
        std::find(kCallbackEventNames.begin(), kCallbackEventNames.end(), next.Text(1));
    claimed =
        DueCallback{next.Text(0), static_cast<CallbackEvent>(event - kCallbackEventNames.begin()),
                    next.Text(2), next.Integer(3) + 1, std::chrono::milliseconds(next.Integer(4))};
  }
  Statement lend(database, "UPDATE callbacks SET attempts = attempts + 1, due_ms = " + now + " + " +
                               std::to_string(lease.count()) + " WHERE job_id = ? AND event = ?");
  lend.Bind(claimed->job_id).Bind(std::string(NameOf(claimed->event))).Run();
  transaction.Commit();
  return claimed;
}

bool EndCallback(const SqlDatabase& database, const DueCallback& callback, CallbackEnd end) {
  const std::string state = end == CallbackEnd::kDelivered ? "delivered" : "given-up";
  Statement update(database, "UPDATE callbacks SET state = '" + state + "'" + kThisClaim);
  return Change(update, callback);
}

bool RetryCallback(const SqlDatabase& database, const DueCallback& callback,
                   std::chrono::milliseconds delay, std::int64_t now_ms) {
  Statement update(database, "UPDATE callbacks SET due_ms = " + Now(database, now_ms) + " + " +
                                 std::to_string(delay.count()) + kThisClaim);
  return Change(update, callback);
}

}  // namespace farhorizon
