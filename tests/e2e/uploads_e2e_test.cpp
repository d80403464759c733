// Resumable uploads to the real program: connections that break, and processes that are killed.
#include <sys/socket.h>
#include <unistd.h>

#include "tests/support/service_fixture.h"

namespace farhorizon {
namespace {

using nlohmann::json;

constexpr const char* kTus = "Tus-Resumable: 1.0.0\r\n";
constexpr const char* kBytes = "Content-Type: application/offset+octet-stream\r\n";

class UploadsE2e : public ServiceE2e {
 protected:
  std::string Make(std::size_t bytes) {
    const RawAnswer made = Ask(port_, "POST", "/uploads",
                               kTus + ("Upload-Length: " + std::to_string(bytes)) +
                                   "\r\nUpload-Metadata: filename Z29vZC5hc2M=\r\n");  // good.asc
    EXPECT_EQ(made.status, 201) << made.head << made.body;
    const std::string location = FieldOf(made, "Location");
    return location.substr(std::min(location.find("/uploads/"), location.size()));
  }
  static std::string FieldOf(const RawAnswer& answer, const std::string& name) {
    const std::size_t at = answer.head.find("\r\n" + name + ": ");
    if (at == std::string::npos) return "";
    const std::size_t begin = at + name.size() + 4;
    return answer.head.substr(begin, answer.head.find("\r\n", begin) - begin);
  }
  static std::string PatchHead(const std::string& path, std::size_t offset, std::size_t bytes) {
    return "PATCH " + path + " HTTP/1.1\r\nHost: localhost\r\nConnection: close\r\n" + kTus +
           kBytes + "Upload-Offset: " + std::to_string(offset) +
           "\r\nContent-Length: " + std::to_string(bytes) + "\r\n\r\n";
  }
  RawAnswer Patch(const std::string& path, std::size_t offset, const std::string& body) {
    return Exchange(port_, PatchHead(path, offset, body.size()) + body);
  }
  // A connection that has sent the head of a PATCH and so much of its body; the caller closes it.
  [[nodiscard]] int Begin(const std::string& path, std::size_t offset, std::size_t bytes,
                          const std::string& body) const {
    const int fd = Connect(port_);
    const std::string text = PatchHead(path, offset, bytes) + body;
    EXPECT_EQ(::send(fd, text.data(), text.size(), MSG_NOSIGNAL),
              static_cast<ssize_t>(text.size()));
    return fd;
  }
  std::string OffsetOf(const std::string& path) {
    return FieldOf(Ask(port_, "HEAD", path, kTus), "Upload-Offset");
  }
  // Asks until the offset is this, for ten seconds.
  bool Reaches(const std::string& path, std::size_t offset) {
    for (int tries = 0; tries < 200; ++tries) {
      if (OffsetOf(path) == std::to_string(offset)) return true;
      std::this_thread::sleep_for(std::chrono::milliseconds(50));
    }
    return false;
  }
  std::string JobOf(const std::string& path) {
    const json body = {{"inputs", {{"dem", {{"href", path}}}, {"crs", "EPSG:4326"}}}};
    const RawAnswer made =
        Ask(port_, "POST", "/jobs", "Content-Type: application/json\r\n", body.dump());
    EXPECT_EQ(made.status, 201) << made.body;
    return made.status == 201 ? "/jobs/" + json::parse(made.body).value("jobID", "") : "";
  }
};

TEST_F(UploadsE2e, KeepsWhatCameBeforeTheConnectionBroke) {
  StartStandIn();
  const std::string dem = SmallGrid();
  const std::string path = Make(dem.size());
  const int fd = Begin(path, 0, dem.size(), dem.substr(0, 500));
  ::close(fd);
  EXPECT_TRUE(Reaches(path, 500));
  const RawAnswer rest = Patch(path, 500, dem.substr(500));
  EXPECT_EQ(rest.status, 204) << rest.head << rest.body;
  EXPECT_EQ(WaitForEnd(JobOf(path)), "successful");
  EXPECT_EQ(LeftOver("spool"), 0U);
}

TEST_F(UploadsE2e, GoesOnAtOnceWhileAnOldConnectionHangs) {
  StartStandIn();
  const std::string dem = SmallGrid();
  const std::string path = Make(dem.size());
  const int hanging = Begin(path, 0, dem.size(), dem.substr(0, 500));
  const auto start = std::chrono::steady_clock::now();
  EXPECT_EQ(Patch(path, 0, dem).status, 204);
  EXPECT_LT(std::chrono::steady_clock::now() - start, std::chrono::seconds(10));
  // What the old one sends from now on changes nothing.
  const std::string late(dem.size() - 500, '9');
  EXPECT_EQ(::send(hanging, late.data(), late.size(), MSG_NOSIGNAL),
            static_cast<ssize_t>(late.size()));
  std::string answer(4096, '\0');
  answer.resize(static_cast<std::size_t>(
      std::max<ssize_t>(0, ::recv(hanging, answer.data(), answer.size(), 0))));
  ::close(hanging);
  EXPECT_NE(answer.find(" 409 "), std::string::npos) << answer;
  const std::string job = JobOf(path);
  EXPECT_EQ(WaitForEnd(job), "successful");
}

TEST_F(UploadsE2e, WhatA204SaysOutlivesAKill) {
  StartStandIn();
  const std::string dem = SmallGrid();
  const std::string path = Make(dem.size());
  ASSERT_EQ(Patch(path, 0, dem.substr(0, 300)).status, 204);
  const int half = Begin(path, 300, dem.size() - 300, dem.substr(300, 100));
  service_->Signal(SIGKILL);
  service_->Wait();
  ::close(half);
  StartStandIn();
  EXPECT_EQ(OffsetOf(path), "300");
  ASSERT_EQ(Patch(path, 300, dem.substr(300)).status, 204);
  service_->Signal(SIGKILL);
  service_->Wait();
  StartStandIn();
  EXPECT_EQ(WaitForEnd(JobOf(path)), "successful");
  service_->Signal(SIGTERM);
  service_->Wait();
  EXPECT_EQ(Run({"fsck", (folder_ / "data").string()}), 0);
}

TEST_F(UploadsE2e, GoesWhenItsTimeHasPassed) {
  StartStandIn({"FARHORIZON_UPLOADS_KEEP_SECONDS=2"});
  const std::string path = Make(10);
  ASSERT_EQ(Patch(path, 0, "12345").status, 204);
  for (int tries = 0; tries < 200 && Ask(port_, "GET", path).status != 404; ++tries) {
    std::this_thread::sleep_for(std::chrono::milliseconds(50));
  }
  EXPECT_EQ(Patch(path, 5, "12345").status, 404);
  std::size_t objects = 1;
  for (int tries = 0; tries < 200 && objects > 0; ++tries) {
    objects = 0;
    for (const auto& entry :
         std::filesystem::recursive_directory_iterator(folder_ / "data" / "objects")) {
      objects += entry.is_regular_file() && entry.path().filename().string().size() == 64 ? 1 : 0;
    }
    std::this_thread::sleep_for(std::chrono::milliseconds(50));
  }
  EXPECT_EQ(objects, 0U);
}

TEST_F(UploadsE2e, PagesOfAnotherOriginMayUseIt) {
  StartStandIn({"FARHORIZON_HTTP_CORS_ORIGIN=https://a.example"});
  const std::string origin = "Origin: https://a.example\r\n";
  const RawAnswer may =
      Ask(port_, "OPTIONS", "/uploads/x", origin + "Access-Control-Request-Method: PATCH\r\n");
  EXPECT_EQ(may.status, 204);
  EXPECT_EQ(FieldOf(may, "Access-Control-Allow-Origin"), "https://a.example");
  EXPECT_NE(FieldOf(may, "Access-Control-Allow-Methods").find("PATCH"), std::string::npos);
  for (const char* name : {"Tus-Resumable", "Upload-Length", "Upload-Offset", "Upload-Metadata"}) {
    EXPECT_NE(FieldOf(may, "Access-Control-Allow-Headers").find(name), std::string::npos) << name;
  }
  const RawAnswer refused = Ask(port_, "POST", "/uploads", origin);
  EXPECT_EQ(refused.status, 412);
  EXPECT_EQ(FieldOf(refused, "Tus-Resumable"), "1.0.0") << "of every answer";
  for (const char* name : {"Location", "Upload-Offset", "Upload-Expires", "Tus-Version"}) {
    EXPECT_NE(FieldOf(refused, "Access-Control-Expose-Headers").find(name), std::string::npos);
  }
  EXPECT_EQ(Ask(port_, "POST", "/uploads", "Origin: https://b.example\r\n").status, 403);
}

}  // namespace
}  // namespace farhorizon
