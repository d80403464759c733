#pragma once

#include <chrono>
#include <memory>
#include <string>
#include <vector>

#include "service/jobs/sql.h"

namespace farhorizon {

/// How long a PostgreSQL server may keep its client waiting.
struct PostgresTimes {
  std::chrono::milliseconds statement{5000};
  std::chrono::milliseconds lock{3000};  ///< of each statement's time
};

/// One connection to a PostgreSQL server, in the schema `farhorizon`. A connection that is lost
/// stays so: no statement goes over another one unseen, which would have none of its locks.
/// Throws SqlFailure: kResourceExhausted without a kind where the server does not answer, is
/// overloaded or does not take writes now, "no-space" where its disk is full; else kIo "job-store".
/// Threads: one at a time, but for Cut.
class PostgresDatabase : public SqlDatabase {
 public:
  /// url: a connection URI or string of libpq. A commit is durable when it is answered, whatever
  /// the server's default.
  PostgresDatabase(const std::string& url, const PostgresTimes& times, SqlDialect dialect);
  ~PostgresDatabase() override;
  PostgresDatabase(const PostgresDatabase&) = delete;
  PostgresDatabase& operator=(const PostgresDatabase&) = delete;

  [[nodiscard]] std::unique_ptr<SqlCursor> Prepare(const std::string& sql) const override;
  void Begin() override;
  void Commit() override;
  void Rollback() override;
  [[nodiscard]] const SqlDialect& dialect() const override { return dialect_; }

  /// Runs statements without parameters that return no row.
  void Execute(const std::string& sql);
  /// False once the connection is lost.
  [[nodiscard]] bool IsOpen() const;
  /// Ends the connection: whoever waits for its server gets an error.
  void Cut() const;

  /// From now on Wait gets what is sent to the channel.
  void Listen(const std::string& channel);
  /// The messages of the channel that came within `most`, from the first on.
  std::vector<std::string> Wait(std::chrono::milliseconds most);

 private:
  struct Session;
  std::unique_ptr<Session> session_;
  SqlDialect dialect_;
};

}  // namespace farhorizon
