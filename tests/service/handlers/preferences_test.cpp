#include "service/handlers/preferences.h"

#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace farhorizon {
namespace {

Preferences Read(const std::vector<std::string>& fields) {
  HttpRequest request;
  for (const std::string& field : fields) request.headers.emplace_back("prefer", field);
  return PreferencesOf(request);
}

TEST(Preferences, AreReadInEveryFormThatTheyMayHave) {
  EXPECT_FALSE(Read({}).respond_async);
  for (const char* field : {"respond-async", "respond-async ", "wait=5, Respond-Async",
                            "respond-async; foo=1", "handling=lenient,respond-async"}) {
    EXPECT_TRUE(Read({field}).respond_async) << field;
  }
  EXPECT_TRUE(Read({"wait=5", "respond-async"}).respond_async);
  EXPECT_FALSE(Read({"respond-asynchronously"}).respond_async);
  EXPECT_EQ(Read({"respond-async, wait=10"}).wait_seconds, 10);
  EXPECT_EQ(Read({"wait = \"7\"", "wait=8"}).wait_seconds, 7);
  EXPECT_GT(Read({"wait=99999999999999999999"}).wait_seconds, 1'000'000);
  for (const char* field : {"wait", "wait=", "wait=-1", "wait=1.5", "wait=-99999999999999999999",
                            "wait=99999999999999999999s"}) {
    EXPECT_FALSE(Read({field}).wait_seconds) << field;
  }
}

}  // namespace
}  // namespace farhorizon
