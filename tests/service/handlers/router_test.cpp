#include "service/handlers/router.h"

#include <gtest/gtest.h>

#include "tests/support/handlers_fixture.h"

namespace farhorizon {
namespace {

using RouterTest = HandlersTest;

TEST_F(RouterTest, TellsTheMethodsThatThereAre) {
  const HttpResponse wrong = Send("PUT", "/jobs");
  EXPECT_EQ(wrong.status, 405);
  EXPECT_EQ(FieldOf(wrong, "Allow"), "POST, GET, HEAD, OPTIONS");
  EXPECT_EQ(Send("OPTIONS", "/jobs").status, 204);
  EXPECT_EQ(Send("GET", "/nothing").status, 404);
}

TEST_F(RouterTest, TakesABodyOnlyWhereThereIsAUseForIt) {
  const HttpResponse refused = Send("GET", "/healthz", {}, "body");
  EXPECT_EQ(refused.status, 413);
  EXPECT_EQ(CodeOf(refused), "body-not-allowed");
  EXPECT_EQ(Send("HEAD", "/healthz").status, 200);
}

}  // namespace
}  // namespace farhorizon
