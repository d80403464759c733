#pragma once

#include <array>
#include <condition_variable>
#include <cstddef>
#include <filesystem>
#include <mutex>

#include "service/jobs/sqlite.h"

namespace farhorizon {

/// Connections that read a database while another one writes to it. In WAL mode neither waits for
/// the other [SQLite WAL]: a status is read while a commit waits for the disk.
/// Threads: safe.
class SqliteReaders {
 public:
  /// Opens all connections. Requires: called once, first; the file has its tables and WAL mode.
  /// Throws: SqlFailure.
  void Open(const std::filesystem::path& path);

  /// Runs work(connection) on one that no other thread uses, and waits for one where all are used.
  template <typename Work>
  auto Read(Work work) {
    const Loan loan(*this);
    return work(loan.database());
  }

 private:
  class Loan {
   public:
    explicit Loan(SqliteReaders& readers) : readers_(readers), at_(readers.Take()) {}
    ~Loan() { readers_.GiveBack(at_); }
    Loan(const Loan&) = delete;
    Loan& operator=(const Loan&) = delete;
    [[nodiscard]] const Database& database() const { return readers_.databases_.at(at_); }

   private:
    SqliteReaders& readers_;
    std::size_t at_;
  };

  std::size_t Take();
  void GiveBack(std::size_t at);

  // As many as handlers read at once on a machine of few cores: a read takes some 50 µs.
  std::array<Database, 3> databases_;
  std::mutex mutex_;
  std::condition_variable given_back_;
  std::array<bool, 3> taken_{};
};

}  // namespace farhorizon
