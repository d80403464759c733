#include "service/jobs/fsck/check_store.h"

#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/io/sha256.h"
#include "service/jobs/fsck/backup_store.h"
#include "service/jobs/job_service.h"
#include "service/jobs/local_object_store.h"
#include "service/jobs/sqlite.h"
#include "service/jobs/sqlite_job_store.h"
#include "tests/support/temp_dir.h"

namespace farhorizon {
namespace {

namespace fs = std::filesystem;
using testing::Contains;
using testing::HasSubstr;
using testing::IsEmpty;

/// A stopped store with a job that succeeded, one that waits and one that was dismissed.
class CheckStoreTest : public testing::Test {
 protected:
  void SetUp() override {
    auto service = OpenService(data_);
    done_ = Submit(*service, "done");
    waiting_ = Submit(*service, "waiting");
    ASSERT_TRUE(service->Dismiss(Submit(*service, "dismissed").id));
    service.reset();
    auto jobs = OpenSqliteJobStore(data_ / "jobs.sqlite");
    auto objects = OpenLocalObjectStore(data_ / "objects");
    const auto job = (*jobs)->ClaimNext(1, {});
    ASSERT_EQ((*job)->id, done_.id);
    SpillFile(folder_ / "result", "a result");
    result_ = (*objects)->PutFile(folder_ / "result")->sha256;
    SpillFile(folder_ / "copy", "a copy");
    copy_ = *(*objects)->PutFile(folder_ / "copy");
    SpillFile(folder_ / "small", "cop");
    small_ = *(*objects)->PutFile(folder_ / "small");
    ASSERT_TRUE(
        *(*jobs)->Publish(done_.id, (*job)->run, {{"r", "a/b", 8, result_, copy_, small_}}, {}, 2));
    (*objects)->Keep({result_, copy_.sha256, small_.sha256});
  }
  static std::unique_ptr<JobService> OpenService(const fs::path& data) {
    JobServiceOptions options;
    options.data = data;
    options.workers = 0;
    options.min_free_bytes = 0;
    auto service = JobService::Open(options);
    EXPECT_TRUE(service) << service.error().message;
    return service ? *std::move(service) : nullptr;
  }
  static Job Submit(JobService& service, const std::string& content) {
    auto spool = service.NewSpoolFile();
    EXPECT_TRUE(spool && spool->Write(content));
    auto job = service.Submit(*spool, {"a.tif", {}, {}, {}, ""});
    EXPECT_TRUE(job);
    return *job;
  }
  FsckSum Check(bool repair = false) {
    lines_.clear();
    const auto sum =
        CheckStore({data_, repair, [&](const std::string& l) { lines_.push_back(l); }});
    EXPECT_TRUE(sum) << sum.error().message;
    return sum ? *sum : FsckSum{};
  }
  /// Mends, and finds nothing more afterwards.
  void ExpectMended(std::int64_t faults) {
    EXPECT_EQ(Check().mended, 0);
    const FsckSum sum = Check(true);
    EXPECT_EQ(sum.faults, faults) << testing::PrintToString(lines_);
    EXPECT_EQ(sum.mended, faults) << testing::PrintToString(lines_);
    EXPECT_EQ(Check().faults, 0) << testing::PrintToString(lines_);
  }
  [[nodiscard]] fs::path ObjectFile(const std::string& sha) const {
    return data_ / "objects" / sha.substr(0, 2) / sha;
  }
  static void Damage(const fs::path& file) {
    fs::permissions(file, fs::perms::owner_all);
    SpillFile(file, "damaged");
  }

  TempDir folder_;
  const fs::path data_ = folder_ / "data";
  Job done_;
  Job waiting_;
  std::string result_;
  StoredObject copy_;   ///< of the result, in gzip as it were
  StoredObject small_;  ///< and in zstd
  std::vector<std::string> lines_;
};

TEST_F(CheckStoreTest, FindsNothingInASoundStore) {
  const FsckSum sum = Check();
  EXPECT_THAT(lines_, IsEmpty());
  EXPECT_EQ(sum.jobs, 3);
  EXPECT_EQ(sum.objects, 6);
  EXPECT_EQ(sum.bytes, 4 + 7 + 9 + 8 + 6 + 3);
  EXPECT_EQ(sum.faults, 0);
}

TEST_F(CheckStoreTest, RunsAJobAgainWhoseResultIsDamaged) {
  Damage(ObjectFile(result_));
  EXPECT_EQ(Check().faults, 2);
  EXPECT_THAT(lines_, Contains(HasSubstr("damaged object " + result_)));
  EXPECT_THAT(lines_, Contains(HasSubstr("job " + done_.id + ": its result r is lost or damaged")));
  ExpectMended(2);
  EXPECT_EQ(SlurpFile(data_ / "stray" / "damaged" / result_), "damaged") << "kept aside";
  EXPECT_EQ(OpenService(data_)->Find(done_.id)->state, JobState::kAccepted);
}

TEST_F(CheckStoreTest, SendsAResultAsItIsWhereItsCopyIsLost) {
  const std::vector<Coding> both = {Coding::kZstd, Coding::kGzip};
  EXPECT_EQ(OpenService(data_)->Open(done_.id, "r", both)->coding, Coding::kZstd);
  Damage(ObjectFile(small_.sha256));
  EXPECT_EQ(OpenService(data_)->Open(done_.id, "r", both)->coding, Coding::kGzip);
  Damage(ObjectFile(copy_.sha256));
  for (const std::vector<Coding>& codings : {both, {}}) {
    const auto artifact = OpenService(data_)->Open(done_.id, "r", codings);
    ASSERT_TRUE(artifact);
    EXPECT_EQ(artifact->coding, Coding::kIdentity);
  }
  ExpectMended(4);
  EXPECT_EQ(OpenService(data_)->Find(done_.id)->state, JobState::kSuccessful);
}

TEST_F(CheckStoreTest, ACopyGoesWithItsJob) {
  ASSERT_TRUE(fs::exists(ObjectFile(copy_.sha256)));
  ASSERT_TRUE(OpenService(data_)->Dismiss(done_.id));
  EXPECT_FALSE(fs::exists(ObjectFile(copy_.sha256)));
  EXPECT_EQ(Check().faults, 0) << testing::PrintToString(lines_);
}

TEST_F(CheckStoreTest, FailsAJobThatHasLostResultAndUpload) {
  fs::remove(ObjectFile(result_));
  fs::remove(ObjectFile(done_.input_sha256));
  ExpectMended(1);
  const auto job = OpenService(data_)->Find(done_.id);
  EXPECT_EQ(job->state, JobState::kFailed);
  EXPECT_EQ(job->failure->kind, "result-corrupt");
}

TEST_F(CheckStoreTest, FailsAWaitingJobThatHasLostItsUpload) {
  fs::remove(ObjectFile(waiting_.input_sha256));
  ExpectMended(1);
  EXPECT_EQ(OpenService(data_)->Find(waiting_.id)->failure->kind, "input-corrupt");
}

TEST_F(CheckStoreTest, FailsAJobWhoseRowCannotBeUnderstood) {
  {
    Database database;
    database.Open(data_ / "jobs.sqlite");
    database.Execute("UPDATE jobs SET parameters = '%' WHERE state = 'accepted'");
  }
  ExpectMended(1);
  EXPECT_EQ(OpenService(data_)->Find(waiting_.id)->state, JobState::kFailed);
}

TEST_F(CheckStoreTest, SaysWhatAKilledProcessHasLeft) {
  SpillFile(data_ / "spool" / "upload-1", "x");
  EXPECT_EQ(Check().faults, 0);
  EXPECT_THAT(lines_, Contains(HasSubstr("spool/upload-1")));
}

TEST_F(CheckStoreTest, SetsStraysAside) {
  const std::string stray = Sha256Hex("stray");
  fs::create_directories(ObjectFile(stray).parent_path());
  SpillFile(ObjectFile(stray), "stray");
  ExpectMended(1);
  EXPECT_EQ(SlurpFile(data_ / "objects" / "stray" / stray), "stray");
}

TEST_F(CheckStoreTest, AcceptsAnOlderDatabaseWhenItIsToldTo) {
  fs::copy_file(data_ / "jobs.sqlite", folder_ / "backup");
  OpenService(data_);
  fs::copy_file(folder_ / "backup", data_ / "jobs.sqlite", fs::copy_options::overwrite_existing);
  JobServiceOptions options;
  options.data = data_;
  EXPECT_THAT(JobService::Open(options).error().message, HasSubstr("--repair"));
  ExpectMended(1);
  EXPECT_NE(OpenService(data_), nullptr);
}

TEST_F(CheckStoreTest, SaysThatTheDatabaseIsGoneAndMakesNone) {
  fs::rename(data_ / "jobs.sqlite", folder_ / "kept");
  EXPECT_EQ(Check(true).faults, 1);
  EXPECT_THAT(lines_, Contains(HasSubstr("jobs.sqlite is missing or empty")));
  EXPECT_FALSE(fs::exists(data_ / "jobs.sqlite"));
}

TEST_F(CheckStoreTest, TakesWhatCanBeReadOutOfADamagedDatabase) {
  // Many jobs, so that the table has many pages; then one of its leaves goes bad.
  {
    Database database;
    database.Open(data_ / "jobs.sqlite");
    database.Execute(("INSERT INTO jobs (id, state, filename, parameters, input_sha256, "
                      "input_bytes, created_ms, updated_ms, message) WITH RECURSIVE n(i) AS "
                      "(SELECT 1 UNION ALL SELECT i + 1 FROM n WHERE i < 300) SELECT "
                      "printf('01900000-0000-7000-8000-%012x', i), 'accepted', 'a.tif', '', '" +
                      waiting_.input_sha256 + "', 7, 3, 3, 'waiting' FROM n")
                         .c_str());
  }
  std::string bytes = SlurpFile(data_ / "jobs.sqlite");
  constexpr std::size_t kPage = 4096;
  std::size_t damaged = 0;
  for (std::size_t page = 2; page * kPage < bytes.size() && damaged == 0; ++page) {
    // 0x0A is a leaf of an index, as of a table WITHOUT ROWID; those of the jobs have messages.
    const std::string content = bytes.substr(page * kPage, kPage);
    if (content[0] == '\x0A' && content.find("acceptedwaiting") == std::string::npos &&
        content.find("waiting") != std::string::npos) {
      damaged = page;
    }
  }
  ASSERT_NE(damaged, 0U);
  for (std::size_t i = 0; i < 64; ++i) bytes[damaged * kPage + i] = '\x5A';
  SpillFile(data_ / "jobs.sqlite", bytes);
  EXPECT_EQ(Check().faults, 1);
  EXPECT_THAT(lines_, Contains(HasSubstr("--repair takes out of it")));
  const FsckSum sum = Check(true);
  EXPECT_GT(sum.jobs, 200) << "one page hides no other";
  EXPECT_LT(sum.jobs, 303);
  EXPECT_TRUE(fs::exists(data_ / "stray" / "database" / "jobs.sqlite"));
  EXPECT_EQ(Check().faults, 0) << testing::PrintToString(lines_);
  EXPECT_NE(OpenService(data_), nullptr);
}

TEST_F(CheckStoreTest, LeavesAStoreAloneThatIsInUse) {
  const auto service = OpenService(data_);
  const auto sum = CheckStore({data_, true, [](const std::string&) {}});
  EXPECT_THAT(sum.error().message, HasSubstr("in use by another farhorizon"));
  EXPECT_THAT(CheckStore({folder_ / "none", false, {}}).error().message, HasSubstr("has no store"));
}

TEST_F(CheckStoreTest, ACopyOfARunningStoreRestores) {
  const auto service = OpenService(data_);
  const Job late = Submit(*service, "late");
  SpillFile(data_ / "keys.json", "the keys");
  const fs::path copy = folder_ / "copy";
  const auto sum = BackUpStore({data_, false, [](const std::string&) {}}, copy);
  ASSERT_TRUE(sum) << sum.error().message;
  EXPECT_EQ(sum->faults, 0);
  EXPECT_EQ(sum->jobs, 4);
  EXPECT_EQ(SlurpFile(copy / "keys.json"), "the keys");
  Submit(*service, "after the copy");
  const auto restored = OpenService(copy);
  ASSERT_NE(restored, nullptr);
  EXPECT_EQ(restored->List({{}, {}, 10})->jobs.size(), 4U);
  EXPECT_TRUE(restored->Find(late.id));
  const auto artifact = restored->Open(done_.id, "r");
  ASSERT_TRUE(artifact);
  EXPECT_EQ(*artifact->object->Read(0, 8), "a result");
  for (const Coding coding : {Coding::kGzip, Coding::kZstd}) {
    EXPECT_EQ(restored->Open(done_.id, "r", std::vector{coding})->coding, coding);
  }
  EXPECT_FALSE(BackUpStore({data_, false, {}}, copy)) << "it is there already";
}

TEST_F(CheckStoreTest, ACopyTellsOfADamagedObject) {
  Damage(ObjectFile(result_));
  const auto sum = BackUpStore({data_, false, [](const std::string&) {}}, folder_ / "copy");
  ASSERT_TRUE(sum);
  EXPECT_EQ(sum->faults, 2);
}

TEST_F(CheckStoreTest, RemovesAnUploadThatLacksBytesAndKeepsTheOthers) {
  std::vector<std::string> ids;
  {
    const auto service = OpenService(data_);
    for (const char* text : {"abc", "def"}) {
      Upload upload;
      upload.bytes = 6;
      upload = *service->Uploads().Create(upload);
      ids.push_back(upload.id);
      auto writer = *service->Uploads().Write(upload, false);
      ASSERT_TRUE(writer->Write(text));
      ASSERT_TRUE(writer->Store());
    }
  }
  EXPECT_EQ(Check().faults, 0) << testing::PrintToString(lines_);
  ASSERT_TRUE(BackUpStore({data_, false, [](const std::string&) {}}, folder_ / "backup"));
  Damage(ObjectFile(Sha256Hex("abc")));
  ExpectMended(2);  // the object, and the upload
  const auto service = OpenService(data_);
  EXPECT_EQ(service->Uploads().Find(ids[0]).error().kind, "no-such-upload");
  EXPECT_EQ(service->Uploads().Find(ids[1])->offset, 3);
  const auto copy = OpenService(folder_ / "backup");
  EXPECT_EQ(copy->Uploads().Find(ids[0])->offset, 3) << "a backup has uploads, too";
}

}  // namespace
}  // namespace farhorizon
