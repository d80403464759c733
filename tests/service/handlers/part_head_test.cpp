#include "service/handlers/part_head.h"

#include <gtest/gtest.h>

namespace farhorizon {
namespace {

TEST(MultipartBoundary, TakesBoundariesOfTheGrammarOnly) {
  EXPECT_EQ(MultipartBoundary("multipart/form-data; boundary=\"a b\""), "a b");
  EXPECT_EQ(MultipartBoundary("Multipart/Form-Data;boundary=abc"), "abc");
  EXPECT_FALSE(MultipartBoundary("multipart/form-data"));
  EXPECT_FALSE(MultipartBoundary("multipart/form-data; boundary=" + std::string(71, 'a')));
  EXPECT_FALSE(MultipartBoundary("multipart/form-data; boundary=\"a\x01\""));
  EXPECT_FALSE(MultipartBoundary("image/tiff; boundary=a"));
}

std::string FilenameOf(const std::string& parameters) {
  const Result<PartHead> head =
      ReadPartHead("Content-Disposition: form-data; name=dem; " + parameters);
  return head ? head->filename.value_or("none") : "refused";
}

TEST(PartHead, ReadsFileNamesAsTheirClientsMeanThem) {
  EXPECT_EQ(FilenameOf(R"(filename="C:\fakepath\N38E007.HGT")"), R"(C:\fakepath\N38E007.HGT)");
  EXPECT_EQ(FilenameOf(R"(filename=C:\dem\a.tif)"), R"(C:\dem\a.tif)");
  EXPECT_EQ(FilenameOf(R"(filename="C:\\dem\\a.tif")"), R"(C:\dem\a.tif)");
  EXPECT_EQ(FilenameOf(R"(filename="a\"b.tif")"), "a\"b.tif");
  EXPECT_EQ(FilenameOf(R"(filename="a%22b%0D%0A.tif")"), "a\"b\r\n.tif");
  EXPECT_EQ(FilenameOf(R"(filename="100%20.tif; x")"), "100%20.tif; x");
  EXPECT_EQ(FilenameOf("filename=\"H\xC3\xB6he.asc\""), "H\xC3\xB6he.asc");
  EXPECT_EQ(FilenameOf("filename=a.tif; filename*=UTF-8''H%C3%B6he.asc"), "H\xC3\xB6he.asc");
  EXPECT_EQ(FilenameOf("filename*=UTF-8''H%C3%B6he.asc; filename=a.tif"), "H\xC3\xB6he.asc");
  EXPECT_EQ(FilenameOf("filename*=broken; filename=a.tif"), "a.tif");
  EXPECT_EQ(FilenameOf("filename*=UTF-8''%C; filename=a.tif"), "a.tif");
  EXPECT_EQ(FilenameOf("x=y"), "none");
}

TEST(PartHead, SaysHowAPartIsEncoded) {
  const std::string disposition = "Content-Disposition: form-data; name=dem";
  for (const char* plain :
       {"", "\r\nContent-Transfer-Encoding: Binary", "\r\nContent-Encoding: identity",
        "\r\nContent-Transfer-Encoding: 8bit\r\nContent-Type: image/tiff"}) {
    const Result<PartHead> head = ReadPartHead(disposition + plain);
    ASSERT_TRUE(head) << plain;
    EXPECT_FALSE(head->coding) << plain;
  }
  EXPECT_EQ(ReadPartHead(disposition + "\r\nContent-Transfer-Encoding: base64")->coding, "base64");
  EXPECT_EQ(ReadPartHead("content-encoding: gzip\r\n" + disposition)->coding, "gzip");
}

TEST(PartHead, NamesAPartOfAForm) {
  for (const char* fields : {"X: y", "Content-Disposition: form-data", "", "no colon",
                             "Content-Disposition: attachment; name=dem"}) {
    EXPECT_FALSE(ReadPartHead(fields)) << fields;
  }
}

}  // namespace
}  // namespace farhorizon
