#include "service/jobs/sqlite.h"

#include <cerrno>

#include <sqlite3.h>

#include "service/jobs/sync_failure.h"

namespace farhorizon {

namespace {

[[noreturn]] void Throw(sqlite3* database, const char* doing) {
  const int code = sqlite3_errcode(database);
  const int extended = sqlite3_extended_errcode(database);
  const int cause = sqlite3_system_errno(database);
  const std::string message = std::string("job store: ") + doing + ": " + sqlite3_errmsg(database);
  // A file that may not grow further (EFBIG, under RLIMIT_FSIZE) is a full disk, too.
  const bool no_room = cause == ENOSPC || cause == EDQUOT || cause == EFBIG;
  const bool unsynced = extended == SQLITE_IOERR_FSYNC || extended == SQLITE_IOERR_DIR_FSYNC;
  if (unsynced && !no_room) EndAfterFailedSync(message);
  const bool full = code == SQLITE_FULL || code == SQLITE_NOMEM ||
                    (code == SQLITE_IOERR && no_room) || (code == SQLITE_CANTOPEN && no_room);
  if (full) throw SqlFailure{{ErrorCode::kResourceExhausted, message, "no-space"}};
  throw SqlFailure{{ErrorCode::kIo, message, "job-store"}};
}

class SqliteCursor : public SqlCursor {
 public:
  SqliteCursor(sqlite3* database, const std::string& sql) : database_(database) {
    if (sqlite3_prepare_v2(database_, sql.c_str(), -1, &handle_, nullptr) != SQLITE_OK) {
      Throw(database_, "prepare");
    }
  }
  ~SqliteCursor() override { sqlite3_finalize(handle_); }
  SqliteCursor(const SqliteCursor&) = delete;
  SqliteCursor& operator=(const SqliteCursor&) = delete;

  void Bind(const std::string& value) override {
    CheckBound(sqlite3_bind_text64(handle_, ++bound_, value.data(), value.size(), SQLITE_TRANSIENT,
                                   SQLITE_UTF8));
  }
  void Bind(std::int64_t value) override {
    CheckBound(sqlite3_bind_int64(handle_, ++bound_, value));
  }
  bool Step() override {
    const int code = sqlite3_step(handle_);
    if (code == SQLITE_ROW) return true;
    if (code == SQLITE_DONE) return false;
    Throw(database_, "step");
  }
  int Changes() override { return sqlite3_changes(database_); }
  [[nodiscard]] bool IsNull(int column) const override {
    return sqlite3_column_type(handle_, column) == SQLITE_NULL;
  }
  [[nodiscard]] std::int64_t Integer(int column) const override {
    return sqlite3_column_int64(handle_, column);
  }
  [[nodiscard]] std::string Text(int column) const override {
    const unsigned char* text = sqlite3_column_text(handle_, column);
    const int size = sqlite3_column_bytes(handle_, column);
    return text == nullptr ? std::string() : std::string(text, text + size);
  }

 private:
  void CheckBound(int code) {
    if (code != SQLITE_OK) Throw(database_, "bind");
  }

  sqlite3* database_;
  sqlite3_stmt* handle_ = nullptr;
  int bound_ = 0;
};

}  // namespace

Database::~Database() { sqlite3_close(handle_); }

void Database::Open(const std::filesystem::path& path) {
  const int flags = SQLITE_OPEN_READWRITE | SQLITE_OPEN_CREATE | SQLITE_OPEN_FULLMUTEX;
  if (sqlite3_open_v2(path.c_str(), &handle_, flags, nullptr) != SQLITE_OK) Throw(handle_, "open");
}

void Database::Execute(const char* sql) {
  if (sqlite3_exec(handle_, sql, nullptr, nullptr, nullptr) != SQLITE_OK) {
    Throw(handle_, "execute");
  }
}

std::int64_t Database::Pragma(const std::string& name) {
  Statement statement(*this, "PRAGMA " + name);
  return statement.Step() ? statement.Integer(0) : 0;
}

std::unique_ptr<SqlCursor> Database::Prepare(const std::string& sql) const {
  return std::make_unique<SqliteCursor>(handle_, sql);
}

void Database::Begin() { Execute("BEGIN IMMEDIATE"); }

void Database::Commit() { Execute("COMMIT"); }

void Database::Rollback() { sqlite3_exec(handle_, "ROLLBACK", nullptr, nullptr, nullptr); }

}  // namespace farhorizon
