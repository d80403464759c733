#include "service/handlers/byte_range.h"

#include <gtest/gtest.h>

namespace farhorizon {
namespace {

Selection Select(std::vector<std::pair<std::string, std::string>> headers,
                 const std::string& method = "GET") {
  HttpRequest request;
  request.method = method;
  request.headers = std::move(headers);
  return SelectBytes(request, "\"tag\"", 100);
}

void ExpectPart(const Selection& selection, std::int64_t offset, std::int64_t bytes) {
  EXPECT_EQ(selection.status, 206);
  EXPECT_EQ(selection.offset, offset);
  EXPECT_EQ(selection.bytes, bytes);
}

TEST(ByteRange, SelectsAPart) {
  ExpectPart(Select({{"range", "bytes=0-9"}}), 0, 10);
  ExpectPart(Select({{"range", "bytes=90-"}}), 90, 10);
  ExpectPart(Select({{"range", "bytes=90-1000"}}), 90, 10);
  ExpectPart(Select({{"range", "bytes=-10"}}), 90, 10);
  ExpectPart(Select({{"range", "bytes=-1000"}}), 0, 100);
}

TEST(ByteRange, SaysWhereNothingIsLeft) {
  EXPECT_EQ(Select({{"range", "bytes=100-"}}).status, 416);
  EXPECT_EQ(Select({{"range", "bytes=-0"}}).status, 416);
}

TEST(ByteRange, AnswersInFullWhatIsNoSingleRange) {
  for (const char* range : {"bytes=0-1,5-6", "bytes=9-0", "bytes=a-b", "lines=0-1", "bytes=-",
                            "bytes=99999999999999999999-"}) {
    EXPECT_EQ(Select({{"range", range}}).status, 200) << range;
  }
  EXPECT_EQ(Select({{"range", "bytes=0-9"}}, "HEAD").status, 200);
}

TEST(ByteRange, HoldsIfRangeToTheStrongTag) {
  EXPECT_EQ(Select({{"range", "bytes=0-9"}, {"if-range", "\"tag\""}}).status, 206);
  EXPECT_EQ(Select({{"range", "bytes=0-9"}, {"if-range", "W/\"tag\""}}).status, 200);
  EXPECT_EQ(Select({{"range", "bytes=0-9"}, {"if-range", "\"other\""}}).status, 200);
}

TEST(ByteRange, KnowsWhatTheClientHas) {
  EXPECT_EQ(Select({{"if-none-match", "\"a\", W/\"tag\""}}).status, 304);
  EXPECT_EQ(Select({{"if-none-match", "*"}}).status, 304);
  EXPECT_EQ(Select({{"if-none-match", "\"a\""}}).status, 200);
  EXPECT_EQ(Select({{"if-match", "\"a\""}}).status, 412);
  EXPECT_EQ(Select({{"if-match", "\"tag\""}}).status, 200);
}

}  // namespace
}  // namespace farhorizon
