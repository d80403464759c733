#include "service/jobs/upload_service.h"

#include <optional>
#include <vector>

#include "service/clock.h"
#include "service/jobs/job.h"
#include "service/jobs/sql_uploads.h"

namespace farhorizon {

Error NoSuchUpload() {
  return {ErrorCode::kNotFound,
          "there is no such upload, or its time has passed; begin anew with POST /uploads",
          "no-such-upload"};
}

Error UploadOffsetMismatch() {
  return {ErrorCode::kInvalidArgument,
          "the upload does not end at this Upload-Offset, or another request goes on with it; ask "
          "for the offset by HEAD and go on from there",
          "upload-offset-mismatch"};
}

Result<Upload> UploadService::Create(Upload upload) {
  upload.created_ms = NowMs();
  upload.expires_ms = upload.created_ms + KeepMs();
  upload.id = NewJobId(upload.created_ms);
  Status stored = stores_.jobs.Transact(
      [&](SqlDatabase& database) { return InsertUpload(database, upload, options_.bounds); });
  if (!stored) return std::move(stored.error());
  return upload;
}

Result<Upload> UploadService::Find(const std::string& id) {
  std::optional<Upload> upload;
  Status read = stores_.jobs.Transact([&](SqlDatabase& database) -> Status {
    upload = SelectUpload(database, id, NowMs());
    return Ok{};
  });
  if (!read) return std::move(read.error());
  if (!upload) return NoSuchUpload();
  return *std::move(upload);
}

Status UploadService::Remove(const std::string& id) {
  return stores_.jobs.Transact([&](SqlDatabase& database) -> Status {
    if (RemoveUpload(database, id)) return Ok{};
    return NoSuchUpload();
  });
}

Result<std::int64_t> UploadService::RemoveExpired(std::int64_t now_ms) {
  std::int64_t removed = 0;
  Status done = stores_.jobs.Transact([&](SqlDatabase& database) -> Status {
    removed = RemoveExpiredUploads(database, now_ms);
    return Ok{};
  });
  if (!done) return std::move(done.error());
  return removed;
}

Status UploadService::CopyTo(const Upload& upload, SpoolFile& to) {
  // Another job may take the parts over meanwhile: they stay until the copy is done.
  const auto pin = stores_.collector.Pin();
  if (!pin) return pin.error();
  std::vector<std::string> objects;
  Status read = stores_.jobs.Transact([&](SqlDatabase& database) -> Status {
    objects.clear();
    const std::optional<Upload> now = SelectUpload(database, upload.id, NowMs());
    if (!now) return NoSuchUpload();
    if (!now->sha256.empty()) objects.push_back(now->sha256);
    for (const UploadPart& part : SelectParts(database, upload.id)) objects.push_back(part.sha256);
    return Ok{};
  });
  if (!read) return read;
  for (const std::string& object : objects) {
    Status copied = AppendObject(stores_.objects, object, to);
    if (!copied) return copied;
  }
  return Ok{};
}

Status UploadService::Settle(const std::string& id, const StoredObject& whole) {
  return stores_.jobs.Transact([&](SqlDatabase& database) -> Status {
    SettleUpload(database, id, whole, NowMs() + KeepMs());
    return Ok{};
  });
}

Result<UploadCounts> UploadService::Count() {
  UploadCounts counts;
  Status read = stores_.jobs.Transact([&](SqlDatabase& database) -> Status {
    counts = CountUploads(database);
    return Ok{};
  });
  if (!read) return std::move(read.error());
  return counts;
}

}  // namespace farhorizon
