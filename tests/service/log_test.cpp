#include "service/log.h"

#include <algorithm>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace farhorizon {
namespace {

using nlohmann::json;
using testing::HasSubstr;
using testing::IsEmpty;

class LogTest : public testing::Test {
 protected:
  void TearDown() override { ConfigureLog({LogLevel::kInfo, LogFormat::kJson}); }

  // What one call of Log writes to standard error.
  static std::string Written(const LogOptions& options, LogLevel level,
                             std::initializer_list<LogField> fields = {}) {
    ConfigureLog(options);
    testing::internal::CaptureStderr();
    Log(level, "serving", fields);
    return testing::internal::GetCapturedStderr();
  }
};

TEST_F(LogTest, WritesAJsonObjectALine) {
  const std::string line =
      Written({LogLevel::kInfo, LogFormat::kJson}, LogLevel::kWarning,
              {{"url", std::string("http://x")}, {"port", std::int64_t{8080}}});
  EXPECT_EQ(std::count(line.begin(), line.end(), '\n'), 1);
  const json object = json::parse(line);
  EXPECT_EQ(object["level"], "warning");
  EXPECT_EQ(object["msg"], "serving");
  EXPECT_EQ(object["url"], "http://x");
  EXPECT_EQ(object["port"], 8080);
  EXPECT_EQ(object["ts"].get<std::string>().size(), 24U);
}

TEST_F(LogTest, WritesTextForPeople) {
  const std::string line =
      Written({LogLevel::kInfo, LogFormat::kText}, LogLevel::kInfo, {{"port", std::int64_t{8080}}});
  EXPECT_THAT(line, HasSubstr("Z info serving port=8080\n"));
}

TEST_F(LogTest, OneCallIsOneLineWhateverTheFieldsHave) {
  const std::string hostile = "a\nb\x1b[31m\xff";
  for (const LogFormat format : {LogFormat::kText, LogFormat::kJson}) {
    const std::string line =
        Written({LogLevel::kInfo, format}, LogLevel::kInfo, {{"name", hostile}});
    EXPECT_EQ(std::count(line.begin(), line.end(), '\n'), 1);
    EXPECT_EQ(line.find('\x1b'), std::string::npos);
    EXPECT_THAT(line, HasSubstr("a\\nb\\u001b[31m"));
  }
}

TEST_F(LogTest, LeavesOutLesserLevels) {
  EXPECT_THAT(Written({LogLevel::kWarning, LogFormat::kJson}, LogLevel::kInfo), IsEmpty());
  EXPECT_THAT(Written({LogLevel::kWarning, LogFormat::kJson}, LogLevel::kError),
              HasSubstr("serving"));
}

TEST_F(LogTest, AutoIsJsonWhereStandardErrorIsNoTerminal) {
  EXPECT_THAT(Written({LogLevel::kInfo, LogFormat::kAuto}, LogLevel::kInfo),
              HasSubstr("\"msg\":\"serving\""));
}

}  // namespace
}  // namespace farhorizon
