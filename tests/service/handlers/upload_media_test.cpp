#include "service/handlers/upload_media.h"

#include <string>
#include <utility>
#include <variant>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace farhorizon {
namespace {

using testing::Contains;
using testing::HasSubstr;
using testing::Key;
using testing::Not;
using testing::Pair;
using Fields = std::vector<std::pair<std::string, std::string>>;

std::variant<UploadMedia, HttpResponse> Read(Fields fields) {
  HttpRequest request;
  request.headers = std::move(fields);
  return ReadUploadMedia(request);
}

// What refuses a request with these fields; a response of status 0 where nothing does.
HttpResponse Refusal(Fields fields) {
  const auto read = Read(std::move(fields));
  const auto* response = std::get_if<HttpResponse>(&read);
  HttpResponse none;
  none.status = 0;
  return response != nullptr ? *response : none;
}

TEST(UploadMedia, TakesTheTypesThatProgramsGiveToFilesOfHeights) {
  for (const char* type : {"image/tiff; application=geotiff", "IMAGE/TIFF", "image/x-tiff", "",
                           "text/plain; charset=utf-8", "application/zip"}) {
    const auto read = Read({{"content-type", type}});
    const auto* media = std::get_if<UploadMedia>(&read);
    ASSERT_NE(media, nullptr) << type;
    EXPECT_FALSE(media->boundary) << type;
  }
  EXPECT_TRUE(std::holds_alternative<UploadMedia>(Read({})));
  const auto form = Read({{"content-type", "multipart/form-data; boundary=B"}});
  EXPECT_EQ(std::get<UploadMedia>(form).boundary, "B");
  EXPECT_EQ(Refusal({{"content-type", "multipart/form-data"}}).status, 400);
}

TEST(UploadMedia, SaysWhichTypesAreTaken) {
  for (const char* type :
       {"application/xml", "multipart/mixed; boundary=B", "text/html", "image/png"}) {
    const HttpResponse refusal = Refusal({{"content-type", type}});
    EXPECT_EQ(refusal.status, 415) << type;
    EXPECT_THAT(refusal.headers, Contains(Pair("Accept-Post", HasSubstr("image/tiff")))) << type;
    EXPECT_THAT(refusal.headers, Not(Contains(Key("Accept-Encoding")))) << type;
  }
  // What curl --data-binary sends unless told otherwise.
  EXPECT_THAT(Refusal({{"content-type", "application/x-www-form-urlencoded"}}).body,
              HasSubstr("-H 'Content-Type: application/octet-stream'"));
}

TEST(UploadMedia, TakesBodiesAsTheyAreOnly) {
  const std::pair<std::string, std::string> tiff = {"content-type", "image/tiff"};
  for (const char* coding : {"gzip", "GZip", "deflate", "br", "identity, zstd", "x-gzip"}) {
    const HttpResponse refusal = Refusal({tiff, {"content-encoding", coding}});
    EXPECT_EQ(refusal.status, 415) << coding;
    EXPECT_THAT(refusal.headers, Contains(Pair("Accept-Encoding", "identity"))) << coding;
    EXPECT_THAT(refusal.body, HasSubstr("Content-Encoding")) << coding;
  }
  EXPECT_EQ(Refusal({tiff, {"content-encoding", "identity"}, {"content-encoding", "br"}}).status,
            415);
  for (const char* coding : {"identity", "Identity, identity", ""}) {
    EXPECT_EQ(Refusal({tiff, {"content-encoding", coding}}).status, 0) << coding;
  }
}

}  // namespace
}  // namespace farhorizon
