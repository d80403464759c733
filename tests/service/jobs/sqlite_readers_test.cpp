#include "service/jobs/sqlite_readers.h"

#include <atomic>
#include <string>
#include <thread>
#include <vector>

#include <gtest/gtest.h>

#include "service/jobs/sqlite_schema.h"
#include "tests/support/temp_dir.h"

namespace farhorizon {
namespace {

class SqliteReadersTest : public testing::Test {
 protected:
  void SetUp() override {
    writer_.Open(folder_ / "jobs.sqlite");
    PrepareSchema(writer_);
    writer_.Execute("CREATE TABLE numbers (n INTEGER)");
    readers_.Open(folder_ / "jobs.sqlite");
  }
  std::int64_t Count() {
    return readers_.Read([](const Database& database) {
      Statement count(database, "SELECT count(*) FROM numbers");
      count.Step();
      return count.Integer(0);
    });
  }

  TempDir folder_;
  Database writer_;
  SqliteReaders readers_;
};

TEST_F(SqliteReadersTest, ReadsWhatIsCommittedWhileAnotherWrites) {
  Transaction transaction(writer_);
  writer_.Execute("INSERT INTO numbers VALUES (1)");
  EXPECT_EQ(Count(), 0);
  transaction.Commit();
  EXPECT_EQ(Count(), 1);
}

TEST_F(SqliteReadersTest, WritesNothing) {
  EXPECT_THROW(readers_.Read([](const Database& database) {
    return Statement(database, "INSERT INTO numbers VALUES (1)").Run();
  }),
               SqlFailure);
  EXPECT_EQ(Count(), 0);
}

TEST_F(SqliteReadersTest, LendsEachConnectionToOneThreadAndTakesItBack) {
  std::atomic<int> within{0};
  std::atomic<int> most{0};
  std::atomic<int> failures{0};
  std::vector<std::thread> threads;
  for (int t = 0; t < 8; ++t) {
    threads.emplace_back([&] {
      for (int i = 0; i < 50; ++i) {
        const bool fails = i % 10 == 0;
        try {
          readers_.Read([&](const Database& database) {
            const int now = ++within;
            for (int seen = most; now > seen && !most.compare_exchange_weak(seen, now);) {
            }
            std::this_thread::yield();
            --within;
            return Statement(database, fails ? "SELECT" : "SELECT 1").Step();
          });
        } catch (SqlFailure&) {
          ++failures;
        }
      }
    });
  }
  for (std::thread& thread : threads) thread.join();
  EXPECT_LE(most, 3);
  EXPECT_EQ(failures, 40);
  EXPECT_EQ(Count(), 0);
}

}  // namespace
}  // namespace farhorizon
