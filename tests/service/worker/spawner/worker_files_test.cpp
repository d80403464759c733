#include "service/worker/spawner/worker_files.h"

#include <algorithm>
#include <filesystem>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/support/temp_dir.h"

namespace farhorizon {
namespace {

namespace fs = std::filesystem;

bool Has(const std::vector<fs::path>& files, const fs::path& file) {
  return std::ranges::find(files, fs::canonical(file)) != files.end();
}

TEST(FilesToExecute, AProgramNeedsItsLoader) {
  const std::vector<fs::path> files = FilesToExecute("/proc/self/exe");
  ASSERT_GE(files.size(), 2U);
  EXPECT_TRUE(Has(files, "/proc/self/exe"));
  EXPECT_THAT(files[1].filename().string(), testing::HasSubstr("ld"));
}

TEST(FilesToExecute, AScriptNeedsItsInterpreterToo) {
  const TempDir folder;
  SpillFile(folder / "plain", "#!/bin/sh\n");
  SpillFile(folder / "by-env", "#! /usr/bin/env  sh\n");
  SpillFile(folder / "of-script", "#!" + (folder / "plain").string() + " -x\n");
  for (const char* name : {"plain", "by-env", "of-script"}) {
    const std::vector<fs::path> files = FilesToExecute(folder / name);
    EXPECT_TRUE(Has(files, folder / name)) << name;
    EXPECT_TRUE(Has(files, "/bin/sh")) << name;
    EXPECT_FALSE(Has(files, "/bin/ls")) << name;
  }
}

TEST(FilesToExecute, WhatIsNoProgramNeedsNothingElse) {
  const TempDir folder;
  SpillFile(folder / "text", "echo");
  SpillFile(folder / "cut", "\177ELF");
  SpillFile(folder / "itself", "#!" + (folder / "itself").string());
  EXPECT_EQ(FilesToExecute(folder / "text").size(), 1U);
  EXPECT_EQ(FilesToExecute(folder / "cut").size(), 1U);
  EXPECT_EQ(FilesToExecute(folder / "itself").size(), 1U);
  EXPECT_TRUE(FilesToExecute(folder / "missing").empty());
}

}  // namespace
}  // namespace farhorizon
