// What a worker that was taken over may leave in its folder.
#include "service/jobs/collect_artifacts.h"

#include <filesystem>
#include <fstream>
#include <functional>
#include <map>
#include <memory>
#include <string>
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/un.h>
#include <unistd.h>

#include <gtest/gtest.h>

#include "core/io/manifest.h"
#include "core/io/sha256.h"
#include "service/jobs/local_object_store.h"
#include "tests/support/temp_dir.h"

namespace farhorizon {
namespace {

namespace fs = std::filesystem;

class CollectArtifactsTest : public testing::Test {
 protected:
  void SetUp() override {
    auto opened = OpenLocalObjectStore(folder_ / "objects");
    ASSERT_TRUE(opened);
    store_ = *std::move(opened);
    SpillFile(folder_ / "secret", "of another job");
    Reset();
  }

  /// An artifact and its manifest, as a sound worker leaves them.
  void Reset() {
    fs::remove_all(Out());
    fs::create_directory(Out());
    SpillFile(Out() / "report.json", "{}");
    List({{"report.json", "application/json", 2, Sha256Hex("{}")}});
  }
  void List(const std::vector<ManifestEntry>& entries) {
    SpillFile(Out() / "manifest.json", WriteManifest(entries));
  }
  [[nodiscard]] fs::path Out() const { return folder_ / "out"; }

  TempDir folder_;
  std::unique_ptr<ObjectStore> store_;
};

TEST_F(CollectArtifactsTest, TakesWhatASoundWorkerLeaves) {
  Result<std::vector<Artifact>> artifacts = CollectArtifacts(Out(), *store_);
  ASSERT_TRUE(artifacts) << artifacts.error().message;
  EXPECT_EQ(artifacts->size(), 2U);
  EXPECT_EQ(store_->List(ObjectList::kAll)->size(), 2U);
}

TEST_F(CollectArtifactsTest, RefusesAllElseWithoutWaiting) {
  const fs::path report = Out() / "report.json";
  const fs::path manifest = Out() / "manifest.json";
  const auto put_in_place = [](const fs::path& path, const auto& make) {
    fs::remove(path);
    make(path);
  };
  const auto fifo = [](const fs::path& path) { ASSERT_EQ(::mkfifo(path.c_str(), 0600), 0); };
  const auto link = [this](const fs::path& path) { fs::create_symlink(folder_ / "secret", path); };
  const auto second = [this](const fs::path& path) {
    fs::create_hard_link(folder_ / "secret", path);
  };
  const auto socket = [](const fs::path& path) {
    const int fd = ::socket(AF_UNIX, SOCK_STREAM, 0);
    struct sockaddr_un address {};
    address.sun_family = AF_UNIX;
    path.string().copy(address.sun_path, sizeof(address.sun_path) - 1);
    ASSERT_EQ(::bind(fd, reinterpret_cast<struct sockaddr*>(&address), sizeof(address)), 0);
    ::close(fd);
  };
  const auto folder = [](const fs::path& path) { fs::create_directory(path); };
  const std::string sha = Sha256Hex("{}");
  const std::map<std::string, std::function<void()>> deeds = {
      {"no folder", [&] { fs::remove_all(Out()); }},
      {"a link for the folder",
       [&] {
         fs::rename(Out(), folder_ / "moved");
         fs::create_directory_symlink(folder_ / "moved", Out());
       }},
      {"a pipe for the manifest", [&] { put_in_place(manifest, fifo); }},
      {"a link for the manifest", [&] { put_in_place(manifest, link); }},
      {"another file's second name for the manifest", [&] { put_in_place(manifest, second); }},
      {"a folder for the manifest", [&] { put_in_place(manifest, folder); }},
      {"a pipe for an artifact", [&] { put_in_place(report, fifo); }},
      {"a link for an artifact", [&] { put_in_place(report, link); }},
      {"another file's second name for an artifact", [&] { put_in_place(report, second); }},
      {"a socket for an artifact", [&] { put_in_place(report, socket); }},
      {"a folder for an artifact", [&] { put_in_place(report, folder); }},
      {"a pipe beside", [&] { fifo(Out() / "beside"); }},
      {"no manifest", [&] { fs::remove(manifest); }},
      {"an empty manifest", [&] { SpillFile(manifest, ""); }},
      {"a deep manifest", [&] { SpillFile(manifest, std::string(100'000, '[')); }},
      {"a large manifest", [&] { fs::resize_file(manifest, 100 << 20); }},
      {"a missing file", [&] { fs::remove(report); }},
      {"a size that lies", [&] { fs::resize_file(report, std::uintmax_t{1} << 40U); }},
      {"bytes that lie", [&] { SpillFile(report, "[]"); }},
      {"a name outside",
       [&] {
         List({{"../secret", "text/plain", 14, sha}});
       }},
      {"a name twice",
       [&] {
         List({{"report.json", "application/json", 2, sha},
               {"report.json", "application/json", 2, sha}});
       }},
      {"a media type that is a header",
       [&] {
         List({{"report.json", "text/html\r\nX: y", 2, sha}});
       }},
      {"thousands of files",
       [&] {
         for (int i = 0; i < 5000; ++i) std::ofstream(Out() / std::to_string(i));
       }},
  };
  for (const auto& [name, deed] : deeds) {
    Reset();
    deed();
    Result<std::vector<Artifact>> artifacts = CollectArtifacts(Out(), *store_);
    ASSERT_FALSE(artifacts) << name;
    EXPECT_EQ(artifacts.error().kind, "worker-crashed") << name << artifacts.error().message;
  }
  EXPECT_EQ(SlurpFile(folder_ / "secret"), "of another job");
}

}  // namespace
}  // namespace farhorizon
