#include "service/jobs/upload_writer.h"

#include <utility>

#include "core/io/sha256.h"
#include "service/clock.h"
#include "service/jobs/sql_uploads.h"
#include "service/jobs/storage_file.h"
#include "service/log.h"

namespace farhorizon {

namespace {

using Clock = std::chrono::steady_clock;

// What a slow client loses with a process that is killed.
constexpr std::chrono::seconds kLongest{10};

Error Damaged() {
  return {ErrorCode::kIo, "the stored upload is damaged; send it again", "input-corrupt"};
}

Status AppendFile(int from, SpoolFile& to) {
  return ForEachPiece(from, "read an upload",
                      [&to](std::string_view piece) { return to.Write(piece); });
}

// False where another request has the turn: parts that are gone are no damage then.
bool WithTurn(JobStore& jobs, const Upload& upload) {
  bool same = true;
  const Status read = jobs.Transact([&](SqlDatabase& database) -> Status {
    const std::optional<Upload> now = SelectUpload(database, upload.id, NowMs());
    same = now && now->turn == upload.turn;
    return Ok{};
  });
  return same || !read;
}

}  // namespace

Status AppendObject(ObjectStore& objects, const std::string& sha256, SpoolFile& to) {
  Result<OpenObject> object = objects.Open(sha256);
  if (!object && object.error().code == ErrorCode::kNotFound) return Damaged();
  if (!object) return std::move(object.error());
  Sha256 sum;
  Status copied =
      ForEachPiece(object->fd.get(), "read an upload", [&](std::string_view piece) -> Status {
        sum.Add(piece);
        return to.Write(piece);
      });
  if (!copied) return copied;
  return sum.Finish().Hex() == sha256 ? Status(Ok{}) : Damaged();
}

UploadWriter::UploadWriter(UploadStores stores, Upload upload, std::int64_t keep_ms, bool whole)
    : stores_(std::move(stores)), upload_(std::move(upload)), keep_ms_(keep_ms), whole_(whole) {}

Result<std::unique_ptr<UploadWriter>> UploadWriter::Begin(UploadStores stores, Upload upload,
                                                          std::int64_t keep_ms, bool whole) {
  std::unique_ptr<UploadWriter> writer(
      new UploadWriter(std::move(stores), std::move(upload), keep_ms, whole));
  Status taken = writer->stores_.jobs.Transact([&writer](SqlDatabase& database) -> Status {
    if (!TakeTurn(database, writer->upload_)) return UploadOffsetMismatch();
    writer->tail_ = SelectParts(database, writer->upload_.id);
    return Ok{};
  });
  if (!taken) return std::move(taken.error());
  return writer;
}

Status UploadWriter::Write(std::string_view bytes) {
  if (!spool_) {
    Result<SpoolFile> made = SpoolFile::Create(stores_.spool);
    if (!made) return std::move(made.error());
    spool_.emplace(*std::move(made));
    spooled_ = Clock::now();
  }
  Status written = spool_->Write(bytes);
  if (!written || whole_) return written;
  const bool full = spool_->bytes() >= kPartBytes || Clock::now() - spooled_ >= kLongest;
  return full ? Store() : Ok{};
}

Status UploadWriter::Store() {
  if (!spool_) return Ok{};
  SpoolFile spool = *std::move(spool_);
  spool_.reset();
  Result<SpoolFile> part = Joined(std::move(spool));
  if (part) return StorePart(*std::move(part));
  return WithTurn(stores_.jobs, upload_) ? Status(std::move(part.error())) : UploadOffsetMismatch();
}

Result<SpoolFile> UploadWriter::Joined(SpoolFile spool) {
  std::size_t first = tail_.size();
  for (std::int64_t bytes = spool.bytes(); first > 0; --first) {
    const UploadPart& before = tail_[first - 1];
    if (before.bytes > bytes || bytes + before.bytes > kPartBytes) break;
    bytes += before.bytes;
  }
  if (first == tail_.size()) return spool;
  Result<SpoolFile> joined = SpoolFile::Create(stores_.spool);
  if (!joined) return joined;
  for (std::size_t i = first; i < tail_.size(); ++i) {
    Status copied = AppendObject(stores_.objects, tail_[i].sha256, *joined);
    if (!copied) return std::move(copied.error());
  }
  const Result<UniqueFd> own = OpenForReading(spool.path());
  Status copied = own ? AppendFile(own->get(), *joined) : Status(own.error());
  if (!copied) return std::move(copied.error());
  tail_.resize(first);
  return joined;
}

Status UploadWriter::StorePart(SpoolFile spool) {
  auto pin = stores_.collector.Pin();
  if (!pin) return std::move(pin.error());
  Result<StoredObject> object = stores_.objects.PutFile(spool.path());
  if (!object) return std::move(object.error());
  const std::int64_t offset = tail_.empty() ? 0 : tail_.back().offset + tail_.back().bytes;
  const UploadPart part{offset, object->bytes, object->sha256};
  const std::int64_t expires_ms = NowMs() + keep_ms_;
  Status stored = stores_.jobs.Transact([&](SqlDatabase& database) -> Status {
    if (AppendPart(database, upload_, part, expires_ms)) return Ok{};
    return SelectUpload(database, upload_.id, NowMs()) ? UploadOffsetMismatch() : NoSuchUpload();
  });
  if (stored) {
    stores_.objects.Keep({part.sha256});
    upload_.offset = part.offset + part.bytes;
    upload_.expires_ms = expires_ms;
    tail_.push_back(part);
    return Ok{};
  }
  pin->reset();
  const Status removed = stores_.collector.RemoveUnlessPinned({part.sha256});
  if (!removed) Log(LogLevel::kWarning, "an object is left", {{"error", removed.error().message}});
  return stored;
}

}  // namespace farhorizon
