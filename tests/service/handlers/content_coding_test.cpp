#include "service/handlers/content_coding.h"

#include <gtest/gtest.h>

namespace farhorizon {
namespace {

bool Accepts(const std::string& field) {
  HttpRequest request;
  request.headers.emplace_back("accept-encoding", field);
  return AcceptsGzip(request);
}

TEST(ContentCoding, IsGzipWhereTheClientWouldHaveIt) {
  for (const char* field :
       {"gzip", "GZip", "x-gzip", "gzip, deflate, br, zstd", "br;q=1.0, gzip;q=0.001", "*",
        "*;q=0.5", "deflate , gzip ; q=1.000", "gzip;Q=0.5, identity;q=0.5", "identity;q=0, *"}) {
    EXPECT_TRUE(Accepts(field)) << field;
  }
}

TEST(ContentCoding, IsNoneElse) {
  EXPECT_FALSE(AcceptsGzip({}));
  for (const char* field :
       {"", "identity", "deflate, br", "gzip;q=0", "gzip;q=0.000, *", "*;q=0",
        "gzip;q=0.5, identity", "identity, *;q=0.9", "gzipped", "gzip;q=", "gzip;q=2", "gzip;q=1.5",
        "gzip;q=0.1234", "gzip;q=-1", "gzip;q=0,5", "gzip;level=9", "gzip;q=0x1"}) {
    EXPECT_FALSE(Accepts(field)) << field;
  }
}

}  // namespace
}  // namespace farhorizon
