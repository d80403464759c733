#include "service/s3/s3_location.h"

#include <gtest/gtest.h>

namespace farhorizon {
namespace {

std::string UrlOf(const std::string& url, const S3Options& options = {},
                  const std::map<std::string, std::string>& environment = {}) {
  const auto location = ReadS3Location(url, options, environment);
  return location ? location->url + " " + location->prefix + " " + location->region
                  : std::string(location.error().kind);
}

TEST(S3Location, NamesTheBucketInTheHostAtAmazonAndElseInThePath) {
  EXPECT_EQ(UrlOf("s3://tiles"), "https://tiles.s3.us-east-1.amazonaws.com/  us-east-1");
  EXPECT_EQ(UrlOf("s3://a.b/x/y", {}, {{"AWS_REGION", "eu-west-1"}}),
            "https://s3.eu-west-1.amazonaws.com/a.b/ x/y/ eu-west-1");
  EXPECT_EQ(UrlOf("s3://tiles/p/", {}, {{"AWS_ENDPOINT_URL", "http://minio:9000/"}}),
            "http://minio:9000/tiles/ p/ us-east-1");
  S3Options options;
  options.endpoint = "https://s3.example";
  options.region = "here";
  options.addressing = S3Addressing::kHost;
  EXPECT_EQ(UrlOf("s3://tiles", options, {{"AWS_ENDPOINT_URL", "http://x"}, {"AWS_REGION", "y"}}),
            "https://tiles.s3.example/  here");
}

TEST(S3Location, RefusesWhatIsNone) {
  for (const char* url : {"s3://", "s3:/x", "tiles", "s3://ab", "s3://Tiles", "s3://-tiles",
                          "s3://tiles/../x", "s3://tiles//x", "s3://tiles/a b", "s3://tiles/%2e",
                          "s3://tiles/é", "s3://u@tiles", "s3://tiles?x"}) {
    EXPECT_EQ(UrlOf(url), "invalid-config") << url;
  }
  for (const char* endpoint : {"ftp://x", "minio:9000", "http://", "http://u:p@x", "http://x/y"}) {
    EXPECT_EQ(UrlOf("s3://tiles", {}, {{"AWS_ENDPOINT_URL", endpoint}}), "invalid-config")
        << endpoint;
  }
  EXPECT_EQ(UrlOf("s3://tiles", {}, {{"AWS_REGION", "eu:s3"}}), "invalid-config");
}

}  // namespace
}  // namespace farhorizon
