#include "service/jobs/job.h"

#include <set>

#include <gtest/gtest.h>

namespace farhorizon {
namespace {

TEST(Job, NothingLeavesATerminalState) {
  for (const JobState from : {JobState::kSuccessful, JobState::kFailed, JobState::kDismissed}) {
    EXPECT_TRUE(IsTerminal(from));
    for (const JobState to : {JobState::kAccepted, JobState::kRunning, JobState::kSuccessful,
                              JobState::kFailed, JobState::kDismissed}) {
      EXPECT_FALSE(MayFollow(from, to));
    }
  }
}

TEST(Job, SucceedsOnlyAfterItRan) {
  EXPECT_FALSE(MayFollow(JobState::kAccepted, JobState::kSuccessful));
  EXPECT_TRUE(MayFollow(JobState::kAccepted, JobState::kFailed)) << "its deadline has passed";
  EXPECT_TRUE(MayFollow(JobState::kAccepted, JobState::kDismissed));
  EXPECT_TRUE(MayFollow(JobState::kRunning, JobState::kAccepted));
}

TEST(Job, StatesAreNamedAsOgcNamesThem) {
  for (const char* name : {"accepted", "running", "successful", "failed", "dismissed"}) {
    ASSERT_TRUE(JobStateOf(name));
    EXPECT_STREQ(JobStateName(*JobStateOf(name)), name);
  }
  EXPECT_FALSE(JobStateOf("queued"));
}

TEST(JobId, IsAVersion7UuidThatGrowsWithTime) {
  const std::string earlier = NewJobId(1'700'000'000'000);
  const std::string later = NewJobId(1'700'000'000'001);
  EXPECT_TRUE(IsJobId(earlier));
  EXPECT_LT(earlier, later);
  EXPECT_EQ(earlier[14], '7');
  std::set<std::string> ids;
  for (int i = 0; i < 1000; ++i) ids.insert(NewJobId(5));
  EXPECT_EQ(ids.size(), 1000U);
}

TEST(JobId, NoOtherTextIsOne) {
  for (const char* text :
       {"", "..", "0190f1e2-0000-7000-8000-00000000000", "../../etc/passwd",
        "0190F1E2-0000-7000-8000-000000000000", "0190f1e2-0000-7000-8000-0000000000000"}) {
    EXPECT_FALSE(IsJobId(text)) << text;
  }
}

TEST(SafeFilename, KeepsWhatIsHarmless) {
  EXPECT_EQ(SafeFilename("N46E007.hgt"), "N46E007.hgt");
  EXPECT_EQ(SafeFilename("../../etc/passwd"), "passwd");
  EXPECT_EQ(SafeFilename("C:\\dem\\a b.tif"), "ab.tif");
  EXPECT_EQ(SafeFilename("-rf"), "rf");
  EXPECT_EQ(SafeFilename(".."), "dem");
  EXPECT_EQ(SafeFilename(""), "dem");
  EXPECT_EQ(SafeFilename("a\r\nX: y\".tif"), "aXy.tif");
  EXPECT_EQ(SafeFilename("C:\\fakepath\\n38e007.HGT"), "n38e007.HGT");
  const std::string kept = SafeFilename(std::string(300, 'a') + ".tif");
  EXPECT_EQ(kept.size(), 100U);
  EXPECT_EQ(kept.substr(96), ".tif");
  EXPECT_TRUE(IsArtifactName(kept));
}

TEST(SafeFilename, KeepsTheEndingByWhichAFormatIsKnown) {
  EXPECT_EQ(SafeFilename("H\xC3\xB6he.asc"), "Hhe.asc");
  EXPECT_EQ(SafeFilename("\xE9\xAB\x98\xE7\xA8\x8B.asc"), "dem.asc");
  EXPECT_EQ(SafeFilename("\xE9\xAB\x98.hgt.zip"), "dem.hgt.zip");
  EXPECT_EQ(SafeFilename(".tif"), "dem.tif");
  EXPECT_EQ(SafeFilename("-.tif"), "dem.tif");
  EXPECT_EQ(SafeFilename("..."), "dem");
  for (const std::size_t length : {95U, 96U, 97U, 98U, 99U, 100U, 200U}) {
    const std::string kept = SafeFilename("." + std::string(length, 'a'));
    EXPECT_LE(kept.size(), 100U) << length;
    EXPECT_EQ(SafeFilename(kept), kept) << length;
  }
}

}  // namespace
}  // namespace farhorizon
