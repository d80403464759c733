#include "service/machine_memory.h"

#include <fstream>
#include <string>

#include <gtest/gtest.h>

#include "tests/support/temp_dir.h"

namespace farhorizon {
namespace {

namespace fs = std::filesystem;

class MachineMemoryTest : public testing::Test {
 protected:
  void Write(const std::string& name, const std::string& text) {
    const fs::path path = folder_ / name;
    fs::create_directories(path.parent_path());
    std::ofstream(path) << text;
  }
  std::int64_t Bytes() { return MachineMemoryBytes(folder_.path()).value_or(-1); }

  TempDir folder_;
};

TEST_F(MachineMemoryTest, IsUnknownWhereTheKernelSaysNothing) { EXPECT_EQ(Bytes(), -1); }

TEST_F(MachineMemoryTest, IsTheMachinesWithoutALimit) {
  Write("proc/meminfo", "MemTotal:        2048 kB\nMemFree:  1 kB\n");
  Write("proc/self/cgroup", "0::/a.slice/b\n");
  Write("sys/fs/cgroup/a.slice/b/memory.max", "max\n");
  EXPECT_EQ(Bytes(), 2048 * 1024);
}

TEST_F(MachineMemoryTest, IsTheLeastLimitOfTheGroupsAboveIt) {
  Write("proc/meminfo", "MemTotal:        2048 kB\n");
  Write("proc/self/cgroup", "0::/a.slice/b\n");
  Write("sys/fs/cgroup/a.slice/b/memory.max", "1000000\n");
  EXPECT_EQ(Bytes(), 1'000'000);
  Write("sys/fs/cgroup/a.slice/memory.max", "900000\n");
  EXPECT_EQ(Bytes(), 900'000);
}

TEST_F(MachineMemoryTest, FindsTheGroupOfAContainerAtTheMountsRoot) {
  Write("proc/meminfo", "MemTotal:        2048 kB\n");
  Write("proc/self/cgroup", "0::/../outside\n");
  Write("sys/fs/cgroup/memory.max", "700000\n");
  EXPECT_EQ(Bytes(), 700'000);
}

TEST_F(MachineMemoryTest, ReadsVersionOneToo) {
  Write("proc/meminfo", "MemTotal:        2048 kB\n");
  Write("proc/self/cgroup", "5:cpu,cpuacct:/x\n4:memory:/x\n0::/\n");
  Write("sys/fs/cgroup/memory/x/memory.limit_in_bytes", "800000\n");
  Write("sys/fs/cgroup/memory/memory.limit_in_bytes", "9223372036854771712\n");
  EXPECT_EQ(Bytes(), 800'000);
}

TEST(MachineMemory, OfThisMachineIsKnown) { EXPECT_GT(MachineMemoryBytes().value_or(0), 1 << 24); }

}  // namespace
}  // namespace farhorizon
