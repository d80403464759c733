#include "service/handlers/content_coding.h"

#include <string>
#include <vector>

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

std::vector<Coding> Codings(const std::string& field) {
  HttpRequest request;
  request.headers.emplace_back("accept-encoding", field);
  return AcceptedCodings(request);
}

TEST(ContentCoding, IsTheOneThatTheClientLikesBetterOrTheSmallerOne) {
  const std::vector<Coding> smaller = {Coding::kZstd, Coding::kGzip};
  const std::vector<Coding> known = {Coding::kGzip, Coding::kZstd};
  EXPECT_EQ(Codings("gzip, deflate, br, zstd"), smaller);
  EXPECT_EQ(Codings("ZSTD;q=0.5, *;q=0.5"), smaller);
  EXPECT_EQ(Codings("zstd;q=0.9, gzip"), known);
  EXPECT_EQ(Codings("zstd"), std::vector{Coding::kZstd});
  EXPECT_EQ(Codings("zstd, gzip;q=0"), std::vector{Coding::kZstd});
  for (const char* field : {"gzip", "*", "zstd;q=0, gzip", "gzip, identity;q=0.5, zstd;q=0.4"}) {
    EXPECT_EQ(Codings(field), std::vector{Coding::kGzip}) << field;
  }
  EXPECT_TRUE(Codings("zstd;q=2, gzip").empty()) << "cannot be read";
  EXPECT_TRUE(Codings("zstandard, zst").empty());
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
