#include "service/jobs/database_url.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace farhorizon {
namespace {

using testing::HasSubstr;
using testing::Not;

TEST(DatabaseUrl, ShowsNoPasswordHoweverItIsWritten) {
  for (const char* url :
       {"postgresql://ada:SEKRIT@db:5432/jobs", "POSTGRESQL://ada:SEKRIT@db/jobs",
        "postgresql://ada:SEKRIT@[::1/jobs", "mysql://ada:SEKRIT@db/jobs",
        "postgresql://ada:p@SEKRIT@db/jobs", "postgresql://ada:p/SEKRIT@db/jobs",
        "postgresql://ada:p?SEKRIT@db/jobs", "postgresql://ada:p%ZZSEKRIT@db/jobs",
        "postgresql://db/jobs?user=ada&password=SEKRIT",
        "postgresql://db/?user=ada&sslpassword=SEKRIT",
        "postgresql://db/jobs?user=ada&pass%77ord=SEKRIT", "user=ada password=SEKRIT",
        "user=ada password = SEKRIT", "user=ada password='a \\' SEKRIT'",
        "user=ada PASSWORD=a\\ SEKRIT", "user=ada password='SEKRIT"}) {
    EXPECT_THAT(WithoutPassword(url), Not(HasSubstr("SEKRIT")));
    EXPECT_THAT(WithoutPassword(url), HasSubstr("ada"));
    const std::string message = std::string("invalid: \"") + url + "?more=1\"";
    EXPECT_THAT(WithoutPassword(message, url), Not(HasSubstr("SEKRIT")));
  }
}

TEST(DatabaseUrl, ShowsTheRest) {
  for (const char* url : {"postgresql://ada@db:5432,db2:5433/jobs?passfile=/etc/pgpass",
                          "host=db user=ada passfile=/etc/pgpass", "postgresql:///jobs", ""}) {
    EXPECT_EQ(WithoutPassword(url), url);
    EXPECT_EQ(WithoutPassword("the server said no", url), "the server said no");
  }
}

TEST(DatabaseUrl, PiecesOfAPasswordThatWasTornApartAreHidden) {
  EXPECT_EQ(
      WithoutPassword("could not translate host name \"SEKRIT@db\"", "postgresql://a:p@SEKRIT@db"),
      "could not translate host name \"***@db\"");
  EXPECT_EQ(WithoutPassword("invalid port \"SEK\"", "postgresql://a:SEK/RIT@db"),
            "invalid port \"***\"");
}

}  // namespace
}  // namespace farhorizon
