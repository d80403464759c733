#include "service/auth/key_meter.h"

#include <gtest/gtest.h>

namespace farhorizon {
namespace {

TEST(KeyMeter, BoundsTheRequestsOfEachOwnerAndFillsEvenly) {
  KeyMeter meter({.requests_per_minute = 3});
  for (int i = 0; i < 3; ++i) EXPECT_EQ(meter.TakeRequest("ada", false, 0), 0) << i;
  EXPECT_EQ(meter.TakeRequest("ada", false, 0), 20);
  EXPECT_EQ(meter.TakeRequest("bob", false, 0), 0) << "another's requests are no concern";
  EXPECT_EQ(meter.TakeRequest("ada", false, 19'000), 1);
  EXPECT_EQ(meter.TakeRequest("ada", false, 20'000), 0);
  EXPECT_GT(meter.TakeRequest("ada", false, 20'000), 0);
}

TEST(KeyMeter, TakesAnUploadOfAnySizeAndThenNoneUntilItIsPaidFor) {
  KeyMeter meter({.upload_bytes_per_hour = 3600});
  EXPECT_EQ(meter.TakeRequest("ada", true, 0), 0);
  meter.TakeBytes("ada", 3700, 0);
  EXPECT_EQ(meter.TakeRequest("ada", true, 0), 101);
  EXPECT_EQ(meter.TakeRequest("ada", false, 0), 0) << "what sends nothing is answered";
  EXPECT_EQ(meter.TakeRequest("bob", true, 0), 0);
  EXPECT_EQ(meter.TakeRequest("ada", true, 101'000), 0);
}

TEST(KeyMeter, IsWithoutBoundByDefault) {
  KeyMeter meter({});
  for (int i = 0; i < 10'000; ++i) ASSERT_EQ(meter.TakeRequest("ada", true, 0), 0);
  meter.TakeBytes("ada", std::int64_t{1} << 50U, 0);
  EXPECT_EQ(meter.TakeRequest("ada", true, 0), 0);
}

}  // namespace
}  // namespace farhorizon
