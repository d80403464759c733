// The properties of uploads on every JobStore.
#include "tests/service/jobs/upload_conformance.h"

#include <atomic>
#include <thread>

#include "service/jobs/sql_uploads.h"

namespace farhorizon {
namespace {

std::string Bytes(std::size_t count, unsigned seed = 1) {
  std::string bytes(count, '\0');
  for (char& byte : bytes) byte = static_cast<char>((seed = seed * 1664525U + 1013904223U) >> 24U);
  return bytes;
}

std::size_t PartsOf(JobStore& store, const std::string& id) {
  std::size_t count = 0;
  EXPECT_TRUE(store.Transact([&](SqlDatabase& database) -> Status {
    count = SelectParts(database, id).size();
    return Ok{};
  }));
  return count;
}

TEST_P(UploadConformance, GoesOnWhereItEndedInAnyProcess) {
  const std::string id = Make(11)->id;
  EXPECT_EQ(OffsetOf(id), 0);
  Append(id, "hello ");
  Restart();
  const Upload half = *service_->Find(id);
  EXPECT_EQ(half.offset, 6);
  EXPECT_EQ(half.bytes, 11);
  EXPECT_EQ(half.filename, "a.tif");
  EXPECT_FALSE(half.IsComplete());
  Append(id, "world");
  Restart();
  EXPECT_TRUE(service_->Find(id)->IsComplete());
  EXPECT_EQ(Read(id), "hello world");
  EXPECT_EQ(Spooled(), 0U);
}

TEST_P(UploadConformance, KeepsWhatIsFullWhileTheRequestGoesOn) {
  const std::string all = Bytes(20'000'000);
  const std::string id = Make(20'000'000)->id;
  {
    auto writer = Writer(id);
    for (std::size_t at = 0; at < all.size(); at += 65536) {
      ASSERT_TRUE(writer->Write(std::string_view(all).substr(at, 65536)));
    }
    EXPECT_EQ(OffsetOf(id), 2 * kPartBytes) << "without Store";
  }
  Restart();
  Append(id, all.substr(static_cast<std::size_t>(OffsetOf(id))));
  EXPECT_TRUE(Read(id) == all);
  EXPECT_EQ(PartsOf(*store_, id), 3U);
}

TEST_P(UploadConformance, StoresNothingOfAWholeBodyBeforeItIsAsked) {
  const std::string id = Make(20'000'000)->id;
  {
    auto writer = Writer(id, true);
    ASSERT_TRUE(writer->Write(Bytes(18'000'000)));
    EXPECT_EQ(OffsetOf(id), 0);
  }
  EXPECT_EQ(OffsetOf(id), 0);
  auto writer = Writer(id, true);
  ASSERT_TRUE(writer->Write(Bytes(18'000'000)));
  ASSERT_TRUE(writer->Store());
  EXPECT_EQ(OffsetOf(id), 18'000'000);
}

TEST_P(UploadConformance, TheNewerRequestWinsAndTheOlderStoresNothing) {
  const std::string id = Make(6)->id;
  auto older = Writer(id);
  ASSERT_TRUE(older->Write("old"));
  auto newer = Writer(id);
  ASSERT_TRUE(newer->Write("new"));
  const Status late = older->Store();
  ASSERT_FALSE(late);
  EXPECT_EQ(late.error().kind, "upload-offset-mismatch");
  EXPECT_EQ(Objects(), 0U) << "that of the older one is gone";
  ASSERT_TRUE(newer->Store());
  EXPECT_EQ(OffsetOf(id), 3);
  Append(id, "est");
  EXPECT_EQ(Read(id), "newest");
}

TEST_P(UploadConformance, OfManyRequestsAtOneOffsetOneIsStored) {
  const std::string id = Make(1000)->id;
  for (int round = 0; round < 5; ++round) {
    const Upload upload = *service_->Find(id);
    std::atomic<int> stored{0};
    std::vector<std::thread> threads;
    for (char c = 'a'; c < 'e'; ++c) {
      threads.emplace_back([&, c] {
        auto writer = service_->Write(upload, false);
        if (writer && (*writer)->Write(std::string(100, c)) && (*writer)->Store()) ++stored;
      });
    }
    for (std::thread& thread : threads) thread.join();
    EXPECT_GE(stored, 1) << "the last that has begun, and before it whoever was faster";
    const std::string all = Read(id);
    EXPECT_EQ(static_cast<std::int64_t>(all.size()), OffsetOf(id));
    for (std::size_t at = 0; at < all.size(); at += 100) {
      EXPECT_EQ(all.substr(at, 100), std::string(100, all[at]));
    }
  }
  EXPECT_EQ(Spooled(), 0U);
}

TEST_P(UploadConformance, RefusesAnotherOffsetOrLength) {
  Upload upload = *Make(10);
  const auto refusal = [&](std::int64_t offset, std::optional<std::int64_t> bytes) {
    upload.offset = offset;
    upload.bytes = bytes;
    auto writer = service_->Write(upload, false);
    return writer ? std::string() : std::string(writer.error().kind);
  };
  EXPECT_EQ(refusal(5, 10), "upload-offset-mismatch");
  EXPECT_EQ(refusal(0, 11), "upload-offset-mismatch");
  EXPECT_EQ(refusal(0, {}), "upload-offset-mismatch");
  EXPECT_EQ(refusal(0, 10), "");
}

TEST_P(UploadConformance, LearnsItsLengthLater) {
  Upload upload = *Make({});
  EXPECT_FALSE(service_->Find(upload.id)->bytes);
  Append(upload.id, "abc");
  EXPECT_FALSE(service_->Find(upload.id)->IsComplete());
  upload = *service_->Find(upload.id);
  upload.bytes = 3;
  ASSERT_TRUE(service_->Write(upload, false));
  EXPECT_TRUE(service_->Find(upload.id)->IsComplete());
}

TEST_P(UploadConformance, ManySmallRequestsMakeFewParts) {
  const std::string all = Bytes(600);
  const std::string id = Make(600)->id;
  for (std::size_t at = 0; at < all.size(); at += 3) Append(id, all.substr(at, 3));
  EXPECT_LE(PartsOf(*store_, id), 9U) << "of 200 requests";
  EXPECT_EQ(Read(id), all);
  EXPECT_EQ(Objects(), PartsOf(*store_, id));
}

TEST_P(UploadConformance, CountsForItsClientAndForAll) {
  const auto kind = [](const Result<Upload>& made) {
    return made ? std::string() : std::string(made.error().kind);
  };
  EXPECT_EQ(kind(Make(10)), "");
  EXPECT_EQ(kind(Make(10)), "");
  const std::string third = Make(10)->id;
  EXPECT_EQ(kind(Make(10)), "too-many-uploads");
  EXPECT_EQ(kind(Make(10, "bob")), "");
  EXPECT_EQ(kind(Make(10, "eve")), "uploads-full");
  ASSERT_TRUE(service_->Remove(third));
  EXPECT_EQ(service_->Count()->uploads, 3);
  EXPECT_EQ(kind(Make(900'000'000)), "too-many-uploads") << "bytes";
  EXPECT_EQ(kind(Make(880'000'000)), "");
  EXPECT_EQ(kind(Make(880'000'000, "bob")), "uploads-full");
}

TEST_P(UploadConformance, OneWithoutALengthCountsAsTheLargest) {
  bounds_.bytes_of_client = 150'000'000;
  Restart();
  Upload first = *Make({});
  EXPECT_EQ(Make({}).error().kind, "too-many-uploads");
  first.bytes = 5;
  ASSERT_TRUE(service_->Write(first, false));
  EXPECT_TRUE(Make({}));
}

TEST_P(UploadConformance, AJobTakesItsBytesOverAndTheUploadCountsNoMore) {
  bounds_.of_client = 1;
  Restart();
  const std::string id = Make(6)->id;
  Append(id, "abc");
  Append(id, "de");
  Append(id, "f");
  EXPECT_FALSE(Make(1));
  const Job job = MakeJobOf(id);
  EXPECT_EQ(Objects(), 1U) << "parts have left";
  EXPECT_EQ(Read(id), "abcdef");
  EXPECT_EQ(service_->Count()->uploads, 0);
  // A second job has the same object.
  EXPECT_EQ(MakeJobOf(id).input_sha256, job.input_sha256);
  EXPECT_TRUE(Make(1));
  // Both dismissed and removed: the upload still has it, and counts again.
  const auto page = store_->List({{}, {}, 10});
  for (const Job& one : page->jobs) {
    ASSERT_TRUE(store_->Dismiss(one.id, ++time_));
    ASSERT_TRUE(store_->Dismiss(one.id, ++time_));
  }
  EXPECT_EQ(Objects(), 1U);
  EXPECT_EQ(Read(id), "abcdef");
  EXPECT_EQ(service_->Count()->uploads, 2);
  ASSERT_TRUE(service_->Remove(id));
  EXPECT_EQ(Objects(), 0U);
}

TEST_P(UploadConformance, ExpiresAfterItsLastBytes) {
  const std::string id = Make(6)->id;
  const std::string other = Make(6)->id;
  Append(id, "abc");
  const std::int64_t later = service_->Find(id)->expires_ms;
  EXPECT_NEAR(static_cast<double>(later), static_cast<double>(NowMs() + kKeepSeconds * 1000), 60e3);
  EXPECT_EQ(*service_->RemoveExpired(later - 60'000), 0);
  EXPECT_EQ(*service_->RemoveExpired(later), 2);
  EXPECT_EQ(service_->Find(id).error().kind, "no-such-upload");
  EXPECT_EQ(service_->Find(other).error().kind, "no-such-upload");
  EXPECT_EQ(Objects(), 0U);
}

TEST_P(UploadConformance, EndsForTheRequestThatWritesWhenItIsRemoved) {
  const std::string id = Make(6)->id;
  auto writer = Writer(id);
  ASSERT_TRUE(writer->Write("abc"));
  ASSERT_TRUE(service_->Remove(id));
  const Status late = writer->Store();
  ASSERT_FALSE(late);
  EXPECT_EQ(late.error().kind, "no-such-upload");
  EXPECT_EQ(service_->Remove(id).error().kind, "no-such-upload");
  EXPECT_EQ(Objects(), 0U);
}

TEST_P(UploadConformance, TellsOfADamagedPart) {
  const std::string id = Make(3)->id;
  Append(id, "abc");
  const std::string name = objects_->List(ObjectList::kAll)->at(0);
  const std::filesystem::path file = folder_ / "o" / "objects" / name.substr(0, 2) / name;
  std::filesystem::permissions(file, std::filesystem::perms::owner_all);
  SpillFile(file, "abd");
  auto spool = SpoolFile::Create(folder_ / "spool");
  EXPECT_EQ(service_->CopyTo(*service_->Find(id), *spool).error().kind, "input-corrupt");
  ASSERT_TRUE(objects_->Remove(name));
  EXPECT_EQ(service_->CopyTo(*service_->Find(id), *spool).error().kind, "input-corrupt");
}

}  // namespace
}  // namespace farhorizon
