#include "service/s3/s3_xml.h"

#include <gtest/gtest.h>

namespace farhorizon {
namespace {

TEST(S3Xml, ReadsFaults) {
  const auto fault = ReadS3Fault(
      "<?xml version=\"1.0\"?>\n<Error><Code>NoSuchKey</Code><Message>a &amp; b</Message></Error>");
  EXPECT_EQ(fault->code, "NoSuchKey");
  EXPECT_EQ(fault->message, "a & b");
  const char* of_many = "<DeleteResult><Error><Code>InternalError</Code></Error></DeleteResult>";
  EXPECT_EQ(ReadS3Fault(of_many)->code, "InternalError");
  for (const char* other : {"", "<html>404</html>", "<DeleteResult/>", "{}", "<Error"}) {
    EXPECT_FALSE(ReadS3Fault(other)) << other;
  }
}

TEST(S3Xml, ReadsPages) {
  const auto page = ReadS3Page(
      "<ListBucketResult xmlns=\"http://s3.amazonaws.com/doc/2006-03-01/\"><IsTruncated>true"
      "</IsTruncated><Contents><Key>a/b</Key></Contents><Contents><Key>c</Key></Contents>"
      "</ListBucketResult>");
  EXPECT_EQ(page->keys, (std::vector<std::string>{"a/b", "c"}));
  EXPECT_TRUE(page->more);
  EXPECT_FALSE(ReadS3Page("<ListBucketResult/>")->more);
  EXPECT_FALSE(ReadS3Page("<Error/>"));
}

TEST(S3Xml, BearsWhatIsNoAnswer) {
  std::string deep;
  for (int i = 0; i < 1'000'000; ++i) deep += "<a>";
  EXPECT_FALSE(ReadS3Fault(deep));
  EXPECT_FALSE(ReadS3Page(deep));
  EXPECT_EQ(ReadS3UploadId(deep), "");
  EXPECT_FALSE(ReadS3Fault("<!DOCTYPE x [<!ENTITY a \"b\">]><Error>&a;</Error>")->code == "b");
}

}  // namespace
}  // namespace farhorizon
