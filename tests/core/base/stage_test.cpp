#include "core/base/stage.h"

#include <cstddef>
#include <set>
#include <string>

#include <gtest/gtest.h>

namespace farhorizon {
namespace {

TEST(StageName, IsOneForEachStageAndFoundAgain) {
  std::set<std::string> names;
  for (std::size_t i = 0; i < kStages.size(); ++i) {
    EXPECT_EQ(static_cast<std::size_t>(kStages[i]), i) << "kStages has each stage at its place";
    const std::string name = StageName(kStages[i]);
    EXPECT_EQ(name.find_first_not_of("abcdefghijklmnopqrstuvwxyz-"), std::string::npos) << name;
    EXPECT_EQ(StageFromName(name), kStages[i]) << name;
    names.insert(name);
  }
  EXPECT_EQ(names.size(), kStages.size());
  EXPECT_EQ(names.count(""), 0U);
}

TEST(StageFromName, KnowsNoOther) {
  for (const char* name : {"", "Sweep", "sweep ", "views", "upload"}) {
    EXPECT_FALSE(StageFromName(name)) << name;
  }
}

}  // namespace
}  // namespace farhorizon
