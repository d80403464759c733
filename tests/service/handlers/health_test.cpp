#include "service/handlers/health.h"

#include <gtest/gtest.h>

#include "tests/support/handlers_fixture.h"

namespace farhorizon {
namespace {

using HealthTest = HandlersTest;

TEST_F(HealthTest, TakesNothingWhileItDrains) {
  EXPECT_EQ(Send("GET", "/readyz").status, 200);
  jobs_->Drain();
  EXPECT_EQ(CodeOf(Post("/jobs", tiff_)), "draining");
  EXPECT_EQ(Send("GET", "/readyz").status, 503);
  EXPECT_EQ(Send("GET", "/healthz").status, 200);
}

}  // namespace
}  // namespace farhorizon
