#include "service/url_query.h"

#include <gtest/gtest.h>

namespace farhorizon {
namespace {

TEST(UrlQuery, DecodesWhatItEncodes) {
  std::string bytes;
  for (int c = 1; c < 256; ++c) bytes += static_cast<char>(c);
  const Parameters parameters = {{"a", bytes}, {bytes, ""}};
  EXPECT_EQ(DecodeQuery(EncodeQuery(parameters)), parameters);
  EXPECT_EQ(EncodeQuery({{"a b", "1&2"}, {"c", "é~"}}), "a%20b=1%262&c=%C3%A9~");
}

TEST(UrlQuery, ReadsQueriesAsFormsWriteThem) {
  EXPECT_EQ(DecodeQuery(""), Parameters{});
  EXPECT_EQ(DecodeQuery("a=My+DEM&&b&c="), (Parameters{{"a", "My DEM"}, {"b", ""}, {"c", ""}}));
  EXPECT_EQ(DecodeQuery("a=b=c"), (Parameters{{"a", "b=c"}}));
}

TEST(UrlQuery, RefusesWhatCanBeReadInTwoWays) {
  for (const char* query :
       {"a=1&a=2", "a=1&%61=2", "=1", "&=", "a=%", "a=%1", "a=%1g", "%zz=1", "a=%00", "a%00b=1"}) {
    EXPECT_FALSE(DecodeQuery(query)) << query;
  }
}

TEST(UrlQuery, ReadsAPlusAsItIsMeant) {
  const auto value = [](const std::string& encoded) {
    return DecodeQuery("a=" + encoded).value_or(Parameters{})["a"];
  };
  // Typed as it is, or with only what curl makes one encode.
  EXPECT_EQ(value("EPSG:4326+5773"), "EPSG:4326+5773");
  EXPECT_EQ(value("EPSG:4326+EPSG:5773"), "EPSG:4326+EPSG:5773");
  EXPECT_EQ(value("IGNF:LAMB93+5720"), "IGNF:LAMB93+5720");
  EXPECT_EQ(value("EPSG%3A4326+5773"), "EPSG:4326+5773");
  EXPECT_EQ(value("-3.4e+38,1E+5"), "-3.4e+38,1E+5");
  EXPECT_EQ(value("+5"), "+5");
  EXPECT_EQ(value("+proj=utm%20+zone=13"), "+proj=utm +zone=13");
  EXPECT_EQ(value("NAD83%20/%20UTM%20zone%2013N%20+%20NAVD88%20height"),
            "NAD83 / UTM zone 13N + NAVD88 height");
  // By programs that encode a query as a form.
  EXPECT_EQ(value("EPSG%3A4326%2B5773"), "EPSG:4326+5773");
  EXPECT_EQ(value("%2Bproj%3Dutm+%2Bzone%3D13+%2bdatum%3DWGS84"),
            "+proj=utm +zone=13 +datum=WGS84");
  EXPECT_EQ(value("WGS+84+%2F+UTM+zone+32N"), "WGS 84 / UTM zone 32N");
  EXPECT_EQ(value("EGM96+height"), "EGM96 height");
}

TEST(UrlQuery, JoinsTheValuesOfAList) {
  EXPECT_EQ(DecodeQuery("n=1&a=x&n=-2,3&n=", {"n"}), (Parameters{{"a", "x"}, {"n", "1,-2,3,"}}));
  EXPECT_FALSE(DecodeQuery("n=1&a=x&a=y", {"n"}));
}

TEST(PercentDecode, LeavesAPlus) { EXPECT_EQ(PercentDecode("a+b%2B"), "a+b+"); }

}  // namespace
}  // namespace farhorizon
