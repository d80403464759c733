#include "core/io/unique_fd.h"

#include <cerrno>
#include <fcntl.h>
#include <unistd.h>

#include <gtest/gtest.h>

namespace farhorizon {
namespace {

int OpenNull() { return ::open("/dev/null", O_RDONLY | O_CLOEXEC); }

bool IsOpen(int fd) { return ::fcntl(fd, F_GETFD) >= 0; }

TEST(UniqueFd, ClosesItsDescriptorOnce) {
  const int number = OpenNull();
  {
    UniqueFd first(number);
    const UniqueFd second(std::move(first));
    EXPECT_FALSE(first);  // NOLINT(bugprone-use-after-move): the state that is tested
    EXPECT_TRUE(second);
    EXPECT_TRUE(IsOpen(number));
  }
  EXPECT_FALSE(IsOpen(number));
}

TEST(UniqueFd, CloseReportsAFailure) {
  UniqueFd file(OpenNull());
  EXPECT_TRUE(file.Close());
  EXPECT_FALSE(file);
  EXPECT_FALSE(file.Close());
}

TEST(UniqueFd, ResetLeavesErrnoAsItIs) {
  UniqueFd file(OpenNull());
  ::close(file.get());
  errno = EACCES;
  file.Reset();
  EXPECT_EQ(errno, EACCES);
}

}  // namespace
}  // namespace farhorizon
