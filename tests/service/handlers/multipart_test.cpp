#include "service/handlers/multipart.h"

#include <map>

#include <gtest/gtest.h>

namespace farhorizon {
namespace {

struct Parsed {
  bool sound = false;
  std::map<std::string, std::string> parts;
  std::optional<std::string> filename;
};

/// Feeds `body` in pieces of `size` bytes.
Parsed Parse(const std::string& body, std::size_t size) {
  Parsed parsed;
  std::string* present = nullptr;
  MultipartParser parser("XX", {[&](const PartHead& head) -> Status {
                                  present = &parsed.parts[head.name];
                                  if (head.filename) parsed.filename = head.filename;
                                  return Ok{};
                                },
                                [&](std::string_view data) -> Status {
                                  present->append(data);
                                  return Ok{};
                                }});
  for (std::size_t at = 0; at < body.size(); at += size) {
    if (!parser.Feed(std::string_view(body).substr(at, size))) return parsed;
  }
  parsed.sound = parser.Finish().has_value();
  return parsed;
}

const std::string kForm =
    "--XX\r\nContent-Disposition: form-data; name=\"dem\"; filename=\"a \\\"b.tif\"\r\n"
    "Content-Type: image/tiff\r\n\r\n\r\n--XXbytes\r\n-\r\n--X\r\n--XX\r\n"
    "content-disposition: form-data; name=params\r\n\r\n{}\r\n--XX--\r\nepilogue";

TEST(Multipart, ReadsTheSameHoweverItIsCut) {
  for (std::size_t size = 1; size <= kForm.size(); ++size) {
    // "\r\n--XXbytes" holds the delimiter followed by neither -- nor CRLF: ill formed, so not that.
    std::string form = kForm;
    form.replace(form.find("--XXbytes"), 9, "--XYbytes");
    const Parsed parsed = Parse(form, size);
    ASSERT_TRUE(parsed.sound) << size;
    ASSERT_EQ(parsed.parts.at("dem"), "\r\n--XYbytes\r\n-\r\n--X") << size;
    ASSERT_EQ(parsed.parts.at("params"), "{}") << size;
    ASSERT_EQ(parsed.filename, "a \"b.tif") << size;
  }
}

TEST(Multipart, RefusesADelimiterThatGoesOn) { EXPECT_FALSE(Parse(kForm, 7).sound); }

TEST(Multipart, RefusesAFormWithoutItsEnd) {
  const std::string whole = "--XX\r\nContent-Disposition: form-data; name=a\r\n\r\n1\r\n--XX--";
  EXPECT_TRUE(Parse(whole, 100).sound);
  for (std::size_t size = 0; size < whole.size(); ++size) {
    EXPECT_FALSE(Parse(whole.substr(0, size), 100).sound) << size;
  }
}

TEST(Multipart, RefusesPartsWithoutAName) {
  EXPECT_FALSE(Parse("--XX\r\nX: y\r\n\r\n1\r\n--XX--", 100).sound);
  EXPECT_FALSE(Parse("--XX\r\nContent-Disposition: form-data\r\n\r\n1\r\n--XX--", 100).sound);
}

TEST(Multipart, BoundsPartsAndHeads) {
  std::string many;
  for (int i = 0; i < 20; ++i) {
    many += "--XX\r\nContent-Disposition: form-data; name=p" + std::to_string(i) + "\r\n\r\n1\r\n";
  }
  EXPECT_FALSE(Parse(many + "--XX--", 1000).sound);
  EXPECT_FALSE(Parse("--XX\r\nX: " + std::string(20000, 'a'), 1000).sound);
}

TEST(Multipart, BoundsHeadsAlikeHoweverTheyAreCut) {
  const std::string name = "Content-Disposition: form-data; name=a\r\nX: ";
  for (const std::size_t length : {std::size_t{8192}, std::size_t{8193}}) {
    const std::string form =
        "--XX\r\n" + name + std::string(length - name.size(), 'a') + "\r\n\r\n1\r\n--XX--";
    for (const std::size_t size : {std::size_t{1}, std::size_t{7}, form.size()}) {
      EXPECT_EQ(Parse(form, size).sound, length == 8192) << length << " by " << size;
    }
  }
}

}  // namespace
}  // namespace farhorizon
