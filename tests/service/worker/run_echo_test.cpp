#include "service/worker/run_echo.h"

#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/io/manifest.h"
#include "service/echo_task.h"
#include "tests/support/temp_dir.h"

namespace farhorizon {
namespace {

TEST(RunEcho, LeavesWhatItWasSentAndAManifest) {
  const TempDir folder;
  SpillFile(
      folder / "in",
      WriteEchoTask({0, {{"text", "text/plain", "hi"}, {"image", "image/tiff", "QUI=", true}}}));
  ASSERT_TRUE(RunEcho((folder / "in").string(), folder.path().string()));
  EXPECT_EQ(SlurpFile(folder / "text"), "hi");
  EXPECT_EQ(SlurpFile(folder / "image"), "AB");
  const auto entries = ReadManifest(SlurpFile(folder / "manifest.json"));
  ASSERT_TRUE(entries);
  ASSERT_EQ(entries->size(), 2U);
  EXPECT_EQ(entries->at(1).media_type, "image/tiff");
  EXPECT_EQ(entries->at(1).bytes, 2U);
  for (const std::string& text :
       {std::string("no JSON"), WriteEchoTask({0, {{"image", "image/tiff", "QUI*", true}}})}) {
    SpillFile(folder / "in", text);
    EXPECT_FALSE(RunEcho((folder / "in").string(), folder.path().string())) << text;
  }
}

}  // namespace
}  // namespace farhorizon
