#include "service/jobs/sqlite_readers.h"

#include <algorithm>
#include <iterator>

namespace farhorizon {

void SqliteReaders::Open(const std::filesystem::path& path) {
  for (Database& database : databases_) {
    database.Open(path);
    database.Execute(
        "PRAGMA query_only = ON; PRAGMA trusted_schema = OFF; PRAGMA mmap_size = 0;"
        "PRAGMA busy_timeout = 2000;");
  }
}

std::size_t SqliteReaders::Take() {
  std::unique_lock lock(mutex_);
  auto* free = taken_.end();
  given_back_.wait(lock, [&] {
    free = std::find(taken_.begin(), taken_.end(), false);
    return free != taken_.end();
  });
  *free = true;
  return static_cast<std::size_t>(std::distance(taken_.begin(), free));
}

void SqliteReaders::GiveBack(std::size_t at) {
  const std::lock_guard lock(mutex_);
  taken_.at(at) = false;
  given_back_.notify_one();
}

}  // namespace farhorizon
