#include "service/handlers/result_archive.h"

#include <cstdlib>
#include <map>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "service/handlers/tar_format.h"
#include "service/handlers/zip_format.h"
#include "tests/support/temp_dir.h"

namespace farhorizon {
namespace {

using Files = std::vector<std::pair<std::string, std::string>>;

// Bytes that are there, given out in pieces that are not asked for.
class TextSource : public BodySource {
 public:
  explicit TextSource(std::string text) : text_(std::move(text)) {}
  Result<std::string_view> Read(std::int64_t offset, std::int64_t most) override {
    return std::string_view(text_).substr(
        static_cast<std::size_t>(offset),
        static_cast<std::size_t>(std::min<std::int64_t>(most, 7)));
  }

 private:
  std::string text_;
};

ArchiveSource Archive(std::unique_ptr<ArchiveFormat> format, const Files& files) {
  std::vector<ArchiveFile> list;
  for (const auto& [name, text] : files)
    list.push_back({name, static_cast<std::int64_t>(text.size())});
  return {std::move(format), list, [files](std::size_t index) {
            return Result<std::shared_ptr<BodySource>>(
                std::make_shared<TextSource>(files.at(index).second));
          }};
}

std::string ReadFrom(ArchiveSource& archive, std::int64_t from, std::int64_t to) {
  std::string bytes;
  while (from < to) {
    const auto piece = archive.Read(from, to - from);
    EXPECT_TRUE(piece && !piece->empty() && static_cast<std::int64_t>(piece->size()) <= to - from);
    if (!piece || piece->empty()) break;
    bytes += *piece;
    from += static_cast<std::int64_t>(piece->size());
  }
  return bytes;
}

const Files kFiles = {{"empty.json", ""},
                      {"lod0.glb", std::string(1000, 'g')},
                      {"exact.bin", std::string(512, '\0')},
                      {"report.json", "{}"}};
constexpr std::int64_t kTime = 1'769'860'800'000;  // 2026-01-31T12:00:00Z

template <typename Format>
std::unique_ptr<ArchiveFormat> Make() {
  return std::make_unique<Format>(kTime);
}

TEST(ResultArchive, IsWhatOtherProgramsRead) {
  const TempDir folder;
  for (const bool zip : {true, false}) {
    ArchiveSource archive = Archive(zip ? Make<ZipFormat>() : Make<TarFormat>(), kFiles);
    const std::string bytes = ReadFrom(archive, 0, archive.bytes());
    SpillFile(folder / "archive", bytes);
    const std::string check = zip ? R"(
import sys, zipfile
z = zipfile.ZipFile(sys.argv[1])
assert z.testzip() is None
files = {i.filename: (z.read(i), i.date_time, i.external_attr >> 16) for i in z.infolist()}
assert {f[1] for f in files.values()} == {(2026, 1, 31, 12, 0, 0)}, files
)"
                                  : R"(
import sys, tarfile
t = tarfile.open(sys.argv[1], 'r:')
files = {m.name: (t.extractfile(m).read(), m.mtime, m.mode) for m in t}
assert {f[1] for f in files.values()} == {1769860800}, files
)";
    SpillFile(folder / "check.py", check + R"(
assert list(files) == ['empty.json', 'lod0.glb', 'exact.bin', 'report.json'], files
assert [f[0] for f in files.values()] == [b'', b'g' * 1000, b'\0' * 512, b'{}']
assert {f[2] & 0o777 for f in files.values()} == {0o644}
)");
    const std::string run =
        "/usr/bin/python3 " + (folder / "check.py").string() + " " + (folder / "archive").string();
    EXPECT_EQ(std::system(run.c_str()), 0) << (zip ? "zip" : "tar");  // NOLINT
  }
}

TEST(ResultArchive, AnyPartOfItIsThatOfTheWhole) {
  for (const bool zip : {true, false}) {
    const auto make = [&] { return Archive(zip ? Make<ZipFormat>() : Make<TarFormat>(), kFiles); };
    ArchiveSource archive = make();
    const std::string whole = ReadFrom(archive, 0, archive.bytes());
    ASSERT_EQ(static_cast<std::int64_t>(whole.size()), archive.bytes());
    for (std::int64_t from = 0; from < archive.bytes(); from += 13) {
      ArchiveSource other = make();  // has read nothing of what is before
      const std::int64_t to = std::min(from + 100, other.bytes());
      EXPECT_EQ(ReadFrom(other, from, to),
                whole.substr(static_cast<std::size_t>(from), static_cast<std::size_t>(to - from)));
    }
  }
}

TEST(ResultArchive, EndsInAnErrorWhereAFileIsLost) {
  ArchiveSource archive(Make<TarFormat>(), {{"a", 5}}, [](std::size_t) {
    return Result<std::shared_ptr<BodySource>>(
        Error{ErrorCode::kIo, "it is gone", "result-corrupt"});
  });
  EXPECT_TRUE(archive.Read(0, 512));
  EXPECT_EQ(archive.Read(512, 5).error().kind, "result-corrupt");
}

// What cannot be made in a test's time: the directory of files that are too large for 32 bits.
TEST(ResultArchive, LargeFilesAndManyAreInZip64) {
  const ZipFormat zip(kTime);
  const std::int64_t large = std::int64_t{5} << 30U;
  const ArchiveFile file{"large", large};
  const std::string head = zip.Head(file, 1);
  EXPECT_EQ(static_cast<std::int64_t>(head.size()), zip.HeadBytes(file));
  EXPECT_EQ(head.substr(18, 8), std::string(8, '\xff'));
  const std::vector<ArchiveFile> files = {file, {"small", 3}};
  const std::vector<std::int64_t> starts = {0, large + 55, large + 93};
  const std::string end = zip.End(files, starts, {1, 2});
  EXPECT_EQ(static_cast<std::int64_t>(end.size()), zip.EndBytes(files, starts));
  EXPECT_EQ(end.size(), 46 + 5 + 20 + 46 + 5 + 12 + 56 + 20 + 22U);
  const std::vector<ArchiveFile> many(70'000, {"n", 0});
  const std::vector<std::int64_t> places(70'001, 31);
  const std::vector<std::uint32_t> sums(70'000, 0);
  EXPECT_EQ(static_cast<std::int64_t>(zip.End(many, places, sums).size()),
            zip.EndBytes(many, places));
  const TarFormat tar(kTime);
  const std::string tar_head = tar.Head({"large", std::int64_t{9} << 30U}, 0);
  EXPECT_EQ(tar_head.substr(124, 12), std::string("\x80\0\0\0\0\0\0\x02\x40\0\0\0", 12));
  EXPECT_EQ(tar.Head({"a", (std::int64_t{8} << 30U) - 1}, 0).substr(124, 11), "77777777777");
}

}  // namespace
}  // namespace farhorizon
