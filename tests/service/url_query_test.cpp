#include "service/url_query.h"

#include <gtest/gtest.h>

namespace farhorizon {
namespace {

TEST(UrlQuery, DecodesWhatItEncodes) {
  std::string bytes;
  for (int c = 0; c < 256; ++c) bytes += static_cast<char>(c);
  const Parameters parameters = {{"a", bytes}, {bytes, ""}};
  EXPECT_EQ(DecodeQuery(EncodeQuery(parameters)), parameters);
  EXPECT_EQ(EncodeQuery({{"a b", "1&2"}, {"c", "é~"}}), "a%20b=1%262&c=%C3%A9~");
}

TEST(UrlQuery, ReadsQueriesAsFormsWriteThem) {
  EXPECT_EQ(DecodeQuery(""), Parameters{});
  EXPECT_EQ(DecodeQuery("a=1+2&&b&c="), (Parameters{{"a", "1 2"}, {"b", ""}, {"c", ""}}));
  EXPECT_EQ(DecodeQuery("a=b=c"), (Parameters{{"a", "b=c"}}));
}

TEST(UrlQuery, RefusesWhatCanBeReadInTwoWays) {
  for (const char* query : {"a=1&a=2", "a=1&%61=2", "=1", "&=", "a=%", "a=%1", "a=%1g", "%zz=1"}) {
    EXPECT_FALSE(DecodeQuery(query)) << query;
  }
}

TEST(PercentDecode, TakesPlusForASpaceInFormsOnly) {
  EXPECT_EQ(PercentDecode("a+b%2B", true), "a b+");
  EXPECT_EQ(PercentDecode("a+b%2B", false), "a+b+");
}

}  // namespace
}  // namespace farhorizon
