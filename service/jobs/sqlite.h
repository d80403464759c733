#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>

#include "service/jobs/sql.h"

struct sqlite3;

namespace farhorizon {

/// One connection to an SQLite file. Throws SqlFailure: kResourceExhausted "no-space" where the
/// disk or the memory is full, else kIo "job-store".
class Database : public SqlDatabase {
 public:
  Database() = default;
  ~Database() override;
  Database(const Database&) = delete;
  Database& operator=(const Database&) = delete;

  /// Opens the file; makes it if it is missing. Requires: called once, before everything else.
  void Open(const std::filesystem::path& path);
  /// Runs statements that return no row.
  void Execute(const char* sql);
  /// The number that a pragma answers; 0 without an answer.
  std::int64_t Pragma(const std::string& name);

  [[nodiscard]] std::unique_ptr<SqlCursor> Prepare(const std::string& sql) const override;
  void Begin() override;
  void Commit() override;
  void Rollback() override;
  [[nodiscard]] const SqlDialect& dialect() const override { return dialect_; }

  [[nodiscard]] sqlite3* handle() const { return handle_; }

 private:
  sqlite3* handle_ = nullptr;
  SqlDialect dialect_;
};

}  // namespace farhorizon
