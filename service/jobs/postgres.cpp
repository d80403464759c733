#include "service/jobs/postgres.h"

#include <optional>
#include <pqxx/pqxx>
#include <string_view>
#include <sys/socket.h>
#include <utility>

#include <nlohmann/json.hpp>

#include "service/jobs/database_url.h"
#include "service/log.h"

namespace farhorizon {

namespace {

constexpr const char* kUnanswered =
    "the database of jobs does not answer now; nothing of this request is stored for sure: try "
    "again later";

// What has come to be known of a failed call.
struct Cause {
  std::string message;
  std::string sqlstate;
  bool lost = false;      // the connection
  bool in_doubt = false;  // a commit that may have been stored
};

bool StartsWith(const std::string& text, std::string_view start) {
  return text.compare(0, start.size(), start) == 0;
}

// Classes and codes of errors: PostgreSQL 15, appendix A.
bool IsPassing(const std::string& sqlstate) {
  // Too many connections, no memory; cancelled at a timeout; a server that starts
  // or stops; a read-only one, as after a failover.
  for (const char* start : {"53", "57014", "57P", "25006", "08"}) {
    if (StartsWith(sqlstate, start)) return true;
  }
  return false;
}

[[noreturn]] void Throw(const char* doing, const Cause& cause) {
  const std::string message = std::string("job store: ") + doing + ": " + cause.message;
  if (cause.sqlstate == "53100") {
    throw SqlFailure{{ErrorCode::kResourceExhausted, message, "no-space"}};
  }
  // A deadlock, or an order of transactions that the server does not keep: it has undone this one.
  if (StartsWith(cause.sqlstate, "40")) {
    throw SqlFailure{
        {ErrorCode::kResourceExhausted, kUnanswered}, !cause.in_doubt, false, cause.message};
  }
  if (cause.sqlstate == "55P03") {
    throw SqlFailure{{ErrorCode::kResourceExhausted, kUnanswered}, false, true, cause.message};
  }
  if (cause.lost || cause.in_doubt || IsPassing(cause.sqlstate)) {
    Log(LogLevel::kWarning, "the database of jobs does not answer", {{"error", message}});
    throw SqlFailure{{ErrorCode::kResourceExhausted, kUnanswered},
                     cause.lost && !cause.in_doubt,
                     false,
                     cause.message};
  }
  throw SqlFailure{{ErrorCode::kIo, message, "job-store"}};
}

// Text as a column takes it: UTF-8 without the character 0.
std::string ColumnText(const std::string& text) {
  using nlohmann::json;
  const auto replace = json::error_handler_t::replace;
  const std::string quoted = json(text).dump(-1, ' ', false, replace);
  std::string valid = json::parse(quoted).get<std::string>();
  std::erase(valid, '\0');
  return valid;
}

// "?" as "$1", "$2" and so on.
std::string Numbered(const std::string& sql) {
  std::string text;
  int count = 0;
  for (const char c : sql) {
    if (c == '?') {
      text += "$" + std::to_string(++count);
    } else {
      text += c;
    }
  }
  return text;
}

// The connection string with what it leaves open.
std::string Complete(const std::string& url) {
  const bool uri = url.find("://") != std::string::npos;
  std::string complete = url;
  for (const auto& [name, value] :
       {std::pair("connect_timeout", "5"), std::pair("application_name", "farhorizon"),
        std::pair("keepalives_idle", "10"), std::pair("keepalives_interval", "3"),
        std::pair("keepalives_count", "3"), std::pair("tcp_user_timeout", "10000")}) {
    if (url.find(std::string(name) + "=") != std::string::npos) continue;
    if (uri) complete += complete.find('?') == std::string::npos ? "?" : "&";
    if (!uri) complete += " ";
    complete.append(name).append("=").append(value);
  }
  return complete;
}

class Channel : public pqxx::notification_receiver {
 public:
  Channel(pqxx::connection& connection, const std::string& name)
      : pqxx::notification_receiver(connection, name) {}
  void operator()(const std::string& payload, int /*backend*/) override {
    messages.push_back(payload);
  }
  std::vector<std::string> messages;
};

}  // namespace

struct PostgresDatabase::Session {
  pqxx::connection connection;
  std::unique_ptr<pqxx::work> transaction;
  std::unique_ptr<Channel> channel;

  explicit Session(const std::string& url) : connection(url) {
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wdeprecated-declarations"
    connection.inhibit_reactivation(true);
#pragma GCC diagnostic pop
  }

  template <typename Work>
  auto Guard(const char* doing, Work work) -> decltype(work()) {
    try {
      return work();
    } catch (const pqxx::in_doubt_error& failure) {
      Throw(doing, {failure.what(), "", true, true});
    } catch (const pqxx::sql_error& failure) {
      Throw(doing, {failure.what(), failure.sqlstate(), IsLost(failure.sqlstate()), false});
    } catch (const std::exception& failure) {
      Throw(doing, {failure.what(), "", IsLost(""), false});
    }
  }
  // A server that stops says so before the connection ends.
  [[nodiscard]] bool IsLost(const std::string& sqlstate) const {
    return !connection.is_open() || StartsWith(sqlstate, "57P0");
  }
  pqxx::result Run(const std::string& sql, const std::vector<std::string>& values) {
    const auto parameters = pqxx::prepare::make_dynamic_params(values);
    if (transaction) return transaction->exec_params(sql, parameters);
    pqxx::nontransaction alone(connection);
    return alone.exec_params(sql, parameters);
  }
};

namespace {

// Runs at the first step, and has all rows then.
template <typename Session>
class PostgresCursor : public SqlCursor {
 public:
  PostgresCursor(Session& session, const std::string& sql)
      : session_(session), sql_(Numbered(sql)) {}

  void Bind(const std::string& value) override { values_.push_back(ColumnText(value)); }
  void Bind(std::int64_t value) override { values_.push_back(std::to_string(value)); }
  bool Step() override {
    if (!rows_) {
      rows_ = session_.Guard("run a statement", [&] { return session_.Run(sql_, values_); });
    } else {
      ++at_;
    }
    return at_ < rows_->size();
  }
  int Changes() override { return static_cast<int>(rows_->affected_rows()); }
  [[nodiscard]] bool IsNull(int column) const override { return Field(column).is_null(); }
  [[nodiscard]] std::int64_t Integer(int column) const override {
    return IsNull(column) ? 0 : std::stoll(Field(column).c_str());
  }
  [[nodiscard]] std::string Text(int column) const override {
    return IsNull(column) ? std::string() : std::string(Field(column).c_str());
  }

 private:
  [[nodiscard]] pqxx::field Field(int column) const { return (*rows_)[at_][column]; }

  Session& session_;
  std::string sql_;
  std::vector<std::string> values_;
  std::optional<pqxx::result> rows_;
  pqxx::result::size_type at_ = 0;
};

}  // namespace

PostgresDatabase::PostgresDatabase(const std::string& url, const PostgresTimes& times,
                                   SqlDialect dialect)
    : dialect_(std::move(dialect)) {
  try {
    session_ = std::make_unique<Session>(Complete(url));
  } catch (const std::exception& failure) {
    Throw("connect", {WithoutPassword(failure.what(), url), "", true, false});
  }
  Execute(
      "SET client_min_messages = error; SET search_path = farhorizon; SET statement_timeout = " +
      std::to_string(times.statement.count()) +
      "; SET lock_timeout = " + std::to_string(times.lock.count()) +
      "; SET idle_in_transaction_session_timeout = 15000; SET client_encoding = 'UTF8'; "
      "SET default_transaction_isolation = 'read committed'; "
      "SELECT set_config('synchronous_commit', 'on', false) "
      "WHERE current_setting('synchronous_commit') = 'off'");
}

PostgresDatabase::~PostgresDatabase() = default;

std::unique_ptr<SqlCursor> PostgresDatabase::Prepare(const std::string& sql) const {
  return std::make_unique<PostgresCursor<Session>>(*session_, sql);
}

void PostgresDatabase::Begin() {
  session_->Guard(
      "begin", [&] { session_->transaction = std::make_unique<pqxx::work>(session_->connection); });
}

void PostgresDatabase::Commit() {
  session_->Guard("commit", [&] { session_->transaction->commit(); });
  session_->transaction.reset();
}

void PostgresDatabase::Rollback() { session_->transaction.reset(); }

void PostgresDatabase::Execute(const std::string& sql) {
  session_->Guard("execute", [&] {
    if (session_->transaction) {
      session_->transaction->exec(sql);
    } else {
      pqxx::nontransaction(session_->connection).exec(sql);
    }
  });
}

bool PostgresDatabase::IsOpen() const { return session_->connection.is_open(); }

void PostgresDatabase::Cut() const { ::shutdown(session_->connection.sock(), SHUT_RDWR); }

void PostgresDatabase::Listen(const std::string& channel) {
  session_->Guard("listen", [&] {
    session_->channel = std::make_unique<Channel>(session_->connection, channel);
  });
}

std::vector<std::string> PostgresDatabase::Wait(std::chrono::milliseconds most) {
  session_->Guard("wait", [&] {
    session_->connection.await_notification(most.count() / 1000, most.count() % 1000 * 1000);
    if (!session_->connection.is_open()) throw pqxx::broken_connection();
  });
  return std::exchange(session_->channel->messages, {});
}

}  // namespace farhorizon
