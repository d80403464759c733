#pragma once

#include <cstdint>
#include <filesystem>
#include <string>

#include "core/base/result.h"

struct sqlite3;
struct sqlite3_stmt;

namespace farhorizon {

/// Thrown by the three classes below where a call of SQLite fails; the job store catches it and
/// returns `error`. kResourceExhausted "no-space" where the disk or the memory is full, else kIo
/// "job-store".
struct SqliteFailure {
  Error error;
};

/// One connection.
class Database {
 public:
  Database() = default;
  ~Database();
  Database(const Database&) = delete;
  Database& operator=(const Database&) = delete;

  /// Opens the file; makes it if it is missing. Requires: called once, before everything else.
  void Open(const std::filesystem::path& path);
  /// Runs statements that return no row.
  void Execute(const char* sql);
  /// The number that a pragma answers; 0 without an answer.
  std::int64_t Pragma(const std::string& name);

  [[nodiscard]] sqlite3* handle() const { return handle_; }

 private:
  sqlite3* handle_ = nullptr;
};

/// One prepared statement, run once. Requires: `database` outlives it.
class Statement {
 public:
  Statement(const Database& database, const std::string& sql);
  ~Statement();
  Statement(const Statement&) = delete;
  Statement& operator=(const Statement&) = delete;

  /// Binds the next parameter.
  Statement& Bind(const std::string& value);
  Statement& Bind(std::int64_t value);

  /// Advances to the next row; false after the last.
  bool Step();
  /// Runs to the end; the number of rows that were changed.
  int Run();

  [[nodiscard]] bool IsNull(int column) const;
  [[nodiscard]] std::int64_t Integer(int column) const;
  [[nodiscard]] std::string Text(int column) const;

 private:
  Statement& CheckBound(int code);

  sqlite3* database_;
  sqlite3_stmt* handle_ = nullptr;
  int bound_ = 0;
};

/// A write transaction; rolled back unless committed. Requires: `database` outlives it.
class Transaction {
 public:
  explicit Transaction(Database& database);
  ~Transaction();
  Transaction(const Transaction&) = delete;
  Transaction& operator=(const Transaction&) = delete;
  void Commit();

 private:
  Database& database_;
  bool committed_ = false;
};

}  // namespace farhorizon
