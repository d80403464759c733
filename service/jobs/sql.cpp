#include "service/jobs/sql.h"

namespace farhorizon {

Statement& Statement::Bind(const std::string& value) {
  cursor_->Bind(value);
  return *this;
}

Statement& Statement::Bind(std::int64_t value) {
  cursor_->Bind(value);
  return *this;
}

int Statement::Run() {
  while (Step()) {
  }
  return cursor_->Changes();
}

Transaction::Transaction(SqlDatabase& database) : database_(database) { database_.Begin(); }

Transaction::~Transaction() {
  if (!committed_) database_.Rollback();
}

void Transaction::Commit() {
  database_.Commit();
  committed_ = true;
}

}  // namespace farhorizon
