#include "service/clock.h"

#include <chrono>
#include <memory>
#include <stop_token>
#include <thread>

#include <gtest/gtest.h>

namespace farhorizon {
namespace {

TEST(Clock, NeverGoesBack) {
  std::int64_t last = NowMs();
  for (int i = 0; i < 1000; ++i) {
    const std::int64_t now = NowMs();
    ASSERT_GE(now, last);
    last = now;
  }
}

TEST(Clock, FormatsTimesInUtc) {
  EXPECT_EQ(FormatTime(0), "1970-01-01T00:00:00.000Z");
  EXPECT_EQ(FormatTime(1'769'860'800'007), "2026-01-31T12:00:00.007Z");
  EXPECT_EQ(FormatHttpDate(1'769'860'800'007), "Sat, 31 Jan 2026 12:00:00 GMT");
}

TEST(Pause, EndsAtAStopRequest) {
  // On the heap: g++ 12 takes one on the stack for uninitialized in the sanitized build.
  const auto stop = std::make_unique<std::stop_source>();
  std::thread other([&] { stop->request_stop(); });
  const auto start = std::chrono::steady_clock::now();
  Pause(std::chrono::hours(1), stop->get_token());
  EXPECT_LT(std::chrono::steady_clock::now() - start, std::chrono::minutes(1));
  other.join();
}

TEST(Pause, LastsItsTimeWithoutAStopRequest) {
  const auto start = std::chrono::steady_clock::now();
  Pause(std::chrono::milliseconds(20), {});
  EXPECT_GE(std::chrono::steady_clock::now() - start, std::chrono::milliseconds(20));
}

}  // namespace
}  // namespace farhorizon
