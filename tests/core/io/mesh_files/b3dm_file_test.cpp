#include "core/io/mesh_files/b3dm_file.h"

#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/support/mesh_writers.h"

namespace farhorizon {
namespace {

using testing::HasSubstr;

std::string Number(std::uint32_t value) {
  std::string bytes;
  for (int shift = 0; shift < 32; shift += 8) bytes += static_cast<char>(value >> shift);
  return bytes;
}

std::string B3dm(const std::string& features, const std::string& glb) {
  return "b3dm" + Number(1) +
         Number(static_cast<std::uint32_t>(28 + features.size() + glb.size())) +
         Number(static_cast<std::uint32_t>(features.size())) + Number(0) + Number(0) + Number(0) +
         features + glb;
}

Result<FileMesh> Read(const std::string& bytes) {
  return ReadB3dm({reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size()}, "/nowhere",
                  {});
}

PlainMesh Triangle() { return {{{1, 2, 3}, {4, 2, 3}, {1, 2, -5}}, {{0, 1, 2}}}; }

TEST(ReadB3dm, MovesTheModelByItsCentreInTheTilesAxes) {
  const std::string glb = GlbBytes(PlainGltf(Triangle()));
  const auto plain = Read(B3dm("", glb));
  ASSERT_TRUE(plain) << plain.error().message;
  EXPECT_EQ(plain->points, Triangle().points);
  const auto moved = Read(B3dm(R"({"BATCH_LENGTH":0,"RTC_CENTER":[100,200,300]})", glb));
  ASSERT_TRUE(moved) << moved.error().message;
  // East 100, north 200, up 300 are x, -z and y of glTF.
  EXPECT_EQ(moved->points[0], (FilePoint{101, 302, -197}));
}

TEST(ReadB3dm, IsCheckedWhereverItIsCut) {
  const std::string whole = B3dm(R"({"RTC_CENTER":[1,2,3]})", GlbBytes(PlainGltf(Triangle())));
  for (std::size_t size = 0; size < whole.size(); size += 3) {
    EXPECT_FALSE(Read(whole.substr(0, size))) << size;
  }
  const auto bad = Read(B3dm(R"({"RTC_CENTER":"here"})", GlbBytes(PlainGltf(Triangle()))));
  ASSERT_FALSE(bad);
  EXPECT_THAT(bad.error().message, HasSubstr("RTC_CENTER"));
}

}  // namespace
}  // namespace farhorizon
