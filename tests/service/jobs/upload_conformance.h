#pragma once

#include <memory>
#include <string>
#include <vector>

#include "service/clock.h"
#include "service/jobs/local_object_store.h"
#include "service/jobs/object_collector.h"
#include "service/jobs/upload_service.h"
#include "tests/service/jobs/job_store_conformance.h"

namespace farhorizon {

/// Uploads in the tables of a job store; each implementation of JobStore instantiates it.
class UploadConformance : public JobStoreConformance {
 protected:
  static constexpr std::int64_t kKeepSeconds = 1000;

  void SetUp() override {
    JobStoreConformance::SetUp();
    std::filesystem::create_directories(folder_ / "spool");
    std::filesystem::create_directories(folder_ / "o");
    objects_ = *OpenLocalObjectStore(folder_ / "o" / "objects");
    Restart();
  }
  // As another process finds it.
  void Restart() {
    service_.reset();
    collector_.reset();
    Reopen();
    collector_ = std::make_unique<ObjectCollector>(*store_, *objects_);
    service_ = std::make_unique<UploadService>(
        UploadStores{*store_, *objects_, *collector_, folder_ / "spool"},
        UploadOptions{bounds_, kKeepSeconds});
  }
  Result<Upload> Make(std::optional<std::int64_t> bytes, const std::string& client = "ada") {
    Upload upload;
    upload.client = client;
    upload.filename = "a.tif";
    upload.bytes = bytes;
    return service_->Create(upload);
  }
  std::unique_ptr<UploadWriter> Writer(const std::string& id, bool whole = false) {
    auto writer = service_->Write(*service_->Find(id), whole);
    EXPECT_TRUE(writer) << writer.error().message;
    return *std::move(writer);
  }
  // One request with these bytes.
  void Append(const std::string& id, const std::string& bytes) {
    auto writer = Writer(id);
    EXPECT_TRUE(writer->Write(bytes));
    EXPECT_TRUE(writer->Store());
  }
  std::string Read(const std::string& id) {
    auto spool = SpoolFile::Create(folder_ / "spool");
    const Status copied = service_->CopyTo(*service_->Find(id), *spool);
    EXPECT_TRUE(copied) << copied.error().message;
    return SlurpFile(spool->path());
  }
  std::int64_t OffsetOf(const std::string& id) { return service_->Find(id)->offset; }
  // A job of these bytes, and the upload settled on its object, as JobService::Submit does it.
  Job MakeJobOf(const std::string& id) {
    auto spool = SpoolFile::Create(folder_ / "spool");
    EXPECT_TRUE(service_->CopyTo(*service_->Find(id), *spool));
    auto pin = *collector_->Pin();
    const StoredObject object = *objects_->PutFile(spool->path());
    const Job job = *store_->Insert({"a.tif", {}, object.sha256, object.bytes, {}}, {}, ++time_);
    objects_->Keep({object.sha256});
    EXPECT_TRUE(service_->Settle(id, object));
    return job;
  }
  // How many objects there are once garbage is gone; each is named by a row.
  std::size_t Objects() {
    EXPECT_TRUE(collector_->RemoveUnacknowledged());
    EXPECT_TRUE(collector_->RemoveGarbage());
    const auto names = objects_->List(ObjectList::kAll);
    for (const std::string& name : *names) EXPECT_TRUE(*store_->IsReferenced(name)) << name;
    return names->size();
  }
  [[nodiscard]] std::size_t Spooled() const {
    const std::filesystem::directory_iterator files(folder_ / "spool");
    return static_cast<std::size_t>(std::distance(begin(files), end(files)));
  }

  UploadBounds bounds_ = {4, 3, 1000'000'000, 900'000'000, 100'000'000};
  std::unique_ptr<ObjectStore> objects_;
  std::unique_ptr<ObjectCollector> collector_;
  std::unique_ptr<UploadService> service_;
};

}  // namespace farhorizon
