#pragma once

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string_view>
#include <vector>

#include "core/base/result.h"
#include "service/jobs/job_store.h"
#include "service/jobs/object_collector.h"
#include "service/jobs/object_store.h"
#include "service/jobs/spool_file.h"
#include "service/jobs/upload.h"

namespace farhorizon {

/// Where uploads are kept. Requires: the stores outlive whatever uses this.
struct UploadStores {
  JobStore& jobs;
  ObjectStore& objects;
  ObjectCollector& collector;
  std::filesystem::path spool;  ///< a folder for files that are under way
};

/// The size from which on a part is stored: what a kill of the process costs a client at most.
inline constexpr std::int64_t kPartBytes = std::int64_t{1} << 23U;

/// Writes the bytes of one request at the end of an upload. They go to a spool file; when that is
/// full, or ten seconds old, it becomes a part: an object, and the row that names it. Parts that
/// are no larger than the one after them are joined with it up to kPartBytes, so that an upload has
/// two of them at most for each kPartBytes and some twenty small ones, however small its requests.
/// Threads: one at a time.
class UploadWriter {
 public:
  /// Takes the turn of the upload, from the offset and with the length that it has here.
  /// whole: nothing is stored before Store.
  /// Errors: kInvalidArgument "upload-offset-mismatch" where it has another by now; those of the
  ///   stores.
  static Result<std::unique_ptr<UploadWriter>> Begin(UploadStores stores, Upload upload,
                                                     std::int64_t keep_ms, bool whole);

  /// Takes the next bytes. Errors: as Store; kResourceExhausted "no-space".
  Status Write(std::string_view bytes);
  /// Makes what has come durable, object and row. Errors: kInvalidArgument
  ///   "upload-offset-mismatch" where another request has the turn; kNotFound "no-such-upload"; of
  ///   the stores.
  Status Store();

  /// The upload as it is stored.
  [[nodiscard]] const Upload& upload() const { return upload_; }
  /// Where it ends with all that has come.
  [[nodiscard]] std::int64_t end() const {
    return upload_.offset + (spool_ ? spool_->bytes() : std::int64_t{0});
  }

 private:
  UploadWriter(UploadStores stores, Upload upload, std::int64_t keep_ms, bool whole);
  /// The spool file with the parts before it that are to be joined with it, which leave `tail_`.
  Result<SpoolFile> Joined(SpoolFile spool);
  Status StorePart(SpoolFile spool);

  UploadStores stores_;
  Upload upload_;
  std::int64_t keep_ms_;
  bool whole_;
  std::vector<UploadPart> tail_;
  std::optional<SpoolFile> spool_;
  std::chrono::steady_clock::time_point spooled_;
};

/// Appends the bytes of an object to a file. Errors: kIo "input-corrupt" where the object is lost
///   or has another SHA-256; those of the stores.
Status AppendObject(ObjectStore& objects, const std::string& sha256, SpoolFile& to);

}  // namespace farhorizon
