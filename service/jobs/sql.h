#pragma once

#include <cstdint>
#include <memory>
#include <string>

#include "core/base/result.h"

namespace farhorizon {

/// Thrown where a call of a database fails; the job store catches it and returns `error`.
struct SqlFailure {
  Error error;
  bool not_done = false;   ///< nothing of the call was stored, and it may succeed at once again
  bool no_lock = false;    ///< others had a lock for as long as one may wait
  std::string cause = {};  ///< what the engine said, where the error does not
};

/// A statement of one engine, run once. Statement is its interface.
class SqlCursor {
 public:
  SqlCursor() = default;
  virtual ~SqlCursor() = default;
  SqlCursor(const SqlCursor&) = delete;
  SqlCursor& operator=(const SqlCursor&) = delete;

  virtual void Bind(const std::string& value) = 0;
  virtual void Bind(std::int64_t value) = 0;
  virtual bool Step() = 0;
  /// The rows that the statement has changed. Requires: Step has returned false.
  virtual int Changes() = 0;
  [[nodiscard]] virtual bool IsNull(int column) const = 0;
  [[nodiscard]] virtual std::int64_t Integer(int column) const = 0;
  [[nodiscard]] virtual std::string Text(int column) const = 0;
};

/// Where the SQL of the job store differs between engines. The defaults are those of a database
/// that one process alone writes to, in one transaction after the other.
struct SqlDialect {
  std::string greatest = "max";  ///< of several values
  std::string least = "min";
  std::string lock_rows = {};     ///< at the end of a SELECT: nobody else changes the rows
  std::string lock_free = {};     ///< the same, leaving out rows that another one has locked
  std::string lock_queue = {};    ///< a statement: nobody else inserts until the transaction ends
  std::string own_runs = {};      ///< a condition: this process runs the job
  std::string claim = {};         ///< what else the start of a run sets
  std::string turn_of = {};       ///< when the client `waiting.client` was served; empty: in memory
  std::string serve_client = {};  ///< a statement with the client: it is served now
  std::string clock_ms = {};      ///< the database's own time; empty: the process' is as good
};

/// One connection to a database of jobs.
class SqlDatabase {
 public:
  SqlDatabase() = default;
  virtual ~SqlDatabase() = default;
  SqlDatabase(const SqlDatabase&) = delete;
  SqlDatabase& operator=(const SqlDatabase&) = delete;

  /// sql: with a ? for each parameter.
  [[nodiscard]] virtual std::unique_ptr<SqlCursor> Prepare(const std::string& sql) const = 0;
  virtual void Begin() = 0;
  virtual void Commit() = 0;
  virtual void Rollback() = 0;
  [[nodiscard]] virtual const SqlDialect& dialect() const = 0;
};

/// One prepared statement, run once. Requires: `database` outlives it.
class Statement {
 public:
  Statement(const SqlDatabase& database, const std::string& sql) : cursor_(database.Prepare(sql)) {}

  /// Binds the next parameter.
  Statement& Bind(const std::string& value);
  Statement& Bind(std::int64_t value);

  /// Advances to the next row; false after the last.
  bool Step() { return cursor_->Step(); }
  /// Runs to the end; the number of rows that were changed.
  int Run();

  [[nodiscard]] bool IsNull(int column) const { return cursor_->IsNull(column); }
  [[nodiscard]] std::int64_t Integer(int column) const { return cursor_->Integer(column); }
  [[nodiscard]] std::string Text(int column) const { return cursor_->Text(column); }

 private:
  std::unique_ptr<SqlCursor> cursor_;
};

/// A write transaction; rolled back unless committed. Requires: `database` outlives it.
class Transaction {
 public:
  explicit Transaction(SqlDatabase& database);
  ~Transaction();
  Transaction(const Transaction&) = delete;
  Transaction& operator=(const Transaction&) = delete;
  void Commit();

 private:
  SqlDatabase& database_;
  bool committed_ = false;
};

}  // namespace farhorizon
