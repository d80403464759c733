#include "service/worker/spawner/fd_message.h"

#include <array>
#include <sys/socket.h>
#include <unistd.h>

#include <gtest/gtest.h>

namespace farhorizon {
namespace {

class FdMessageTest : public testing::Test {
 protected:
  void SetUp() override {
    std::array<int, 2> ends{};
    ASSERT_EQ(::socketpair(AF_UNIX, SOCK_SEQPACKET | SOCK_CLOEXEC, 0, ends.data()), 0);
    near_.Reset(ends[0]);
    far_.Reset(ends[1]);
  }

  UniqueFd near_;
  UniqueFd far_;
};

TEST_F(FdMessageTest, CarriesTextAndDescriptors) {
  std::array<int, 2> pipe{};
  ASSERT_EQ(::pipe(pipe.data()), 0);
  const UniqueFd reading(pipe[0]);
  UniqueFd writing(pipe[1]);
  ASSERT_TRUE(SendFds(near_.get(), "two", {reading.get(), writing.get()}));
  ASSERT_TRUE(SendFds(near_.get(), "none", {}));
  writing.Reset();
  FdMessage message = ReceiveFds(far_.get());
  EXPECT_EQ(message.text, "two");
  ASSERT_EQ(message.descriptors.size(), 2U);
  EXPECT_EQ(::write(message.descriptors[1].get(), "x", 1), 1);
  char byte = 0;
  EXPECT_EQ(::read(reading.get(), &byte, 1), 1);
  EXPECT_EQ(byte, 'x');
  message = ReceiveFds(far_.get());
  EXPECT_EQ(message.text, "none");
  EXPECT_TRUE(message.descriptors.empty());
}

TEST_F(FdMessageTest, TellsThatTheOtherEndIsGone) {
  near_.Reset();
  EXPECT_TRUE(ReceiveFds(far_.get()).text.empty());
  EXPECT_FALSE(SendFds(far_.get(), "x", {}));
}

}  // namespace
}  // namespace farhorizon
