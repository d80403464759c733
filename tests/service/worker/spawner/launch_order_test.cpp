#include "service/worker/spawner/launch_order.h"

#include <gtest/gtest.h>

namespace farhorizon {
namespace {

TEST(LaunchOrder, IsReadAsItWasWritten) {
  const LaunchOrder order{"/usr/bin/other", true, "/data/work/a b", {1, 2, 3, 4, 5}};
  Result<LaunchOrder> read = ReadOrder(WriteOrder(order));
  ASSERT_TRUE(read);
  EXPECT_EQ(read->program, order.program);
  EXPECT_EQ(read->probe_only, order.probe_only);
  EXPECT_EQ(read->directory, order.directory);
  EXPECT_EQ(read->limits.memory_bytes, 1);
  EXPECT_EQ(read->limits.cpu_seconds, 2);
  EXPECT_EQ(read->limits.wall_seconds, 3);
  EXPECT_EQ(read->limits.file_bytes, 4);
  EXPECT_EQ(read->limits.open_files, 5);
}

TEST(LaunchOrder, RefusesOtherTexts) {
  for (const char* text : {"", "{}", "[1]", "{\"program\": 1}"}) EXPECT_FALSE(ReadOrder(text));
}

}  // namespace
}  // namespace farhorizon
