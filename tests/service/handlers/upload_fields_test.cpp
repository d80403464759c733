#include "service/handlers/upload_fields.h"

#include <string>

#include <gtest/gtest.h>

namespace farhorizon {
namespace {

HttpRequest With(const std::string& name, const std::string& value) {
  HttpRequest request;
  request.headers = {{name, value}};
  return request;
}

TEST(UploadFields, ReadNumbersOfAnySize) {
  const auto offset = [](const std::string& text) {
    const auto read = ReadUploadOffset(With("upload-offset", text));
    return read ? *read : -1;
  };
  EXPECT_EQ(offset("0"), 0);
  EXPECT_EQ(offset("0000000000000000000000000000005"), 5);
  EXPECT_EQ(offset("999999999999999999"), 999'999'999'999'999'999);
  EXPECT_EQ(offset("9223372036854775808"), 1'000'000'000'000'000'000) << "2^63";
  EXPECT_EQ(offset("18446744073709551616"), 1'000'000'000'000'000'000) << "2^64";
  for (const char* text : {"", "-1", "+1", " 1", "1 ", "1e3", "0x1", "1,000"}) {
    EXPECT_EQ(offset(text), -1) << text;
  }
}

TEST(UploadFields, ReadMetadataThatClientsSend) {
  // tus-js-client; Uppy sends `name` and `type`, too; "Höhe.tif" in UTF-8.
  const auto read = [](const std::string& text) {
    return ReadUploadMetadata(With("upload-metadata", text));
  };
  auto metadata =
      read("relativePath bnVsbA==,name SMO2aGUudGlm,type aW1hZ2UvdGlmZg==,filename SMO2aGUudGlm");
  ASSERT_TRUE(metadata);
  EXPECT_EQ(metadata->filename, "H\xC3\xB6he.tif");
  EXPECT_EQ(metadata->file_type, "image/tiff");
  metadata = read("is_confidential, name YQ ,filename ");
  ASSERT_TRUE(metadata) << "without a value, without padding";
  EXPECT_EQ(metadata->filename, "a");
  EXPECT_EQ(metadata->text, "is_confidential, name YQ ,filename ");
  EXPECT_EQ(read("type w7Y=")->file_type, "") << "no media type has an umlaut";
  EXPECT_TRUE(ReadUploadMetadata({}));
  EXPECT_FALSE(read("filename Cg==")) << "a line feed";
}

}  // namespace
}  // namespace farhorizon
