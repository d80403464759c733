#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <utility>

#include "core/base/result.h"
#include "service/jobs/spool_file.h"
#include "service/jobs/upload.h"
#include "service/jobs/upload_writer.h"

namespace farhorizon {

/// Uploads that come in over several requests, to any of the services that share the stores: no
/// process keeps anything of them. Errors, of every call: those of the stores.
/// Threads: safe.
class UploadService {
 public:
  UploadService(UploadStores stores, const UploadOptions& options)
      : stores_(std::move(stores)), options_(options) {}

  /// Stores an empty upload: id and times of `upload` are set here. Errors: kResourceExhausted
  ///   "body-too-large", "too-many-uploads", "uploads-full".
  Result<Upload> Create(Upload upload);
  /// Errors: kNotFound "no-such-upload", also where its time has passed.
  Result<Upload> Find(const std::string& id);
  /// As UploadWriter::Begin has it.
  Result<std::unique_ptr<UploadWriter>> Write(const Upload& upload, bool whole) {
    return UploadWriter::Begin(stores_, upload, KeepMs(), whole);
  }
  /// Removes the upload; jobs of it keep their bytes. Errors: kNotFound "no-such-upload".
  Status Remove(const std::string& id);
  /// Removes those whose time has passed, at most a hundred; returns how many.
  Result<std::int64_t> RemoveExpired(std::int64_t now_ms);

  /// Appends the bytes of a complete upload to a file. Errors: kIo "input-corrupt"; kNotFound
  /// "no-such-upload".
  Status CopyTo(const Upload& upload, SpoolFile& to);
  /// Lets the object of a job be the upload's, in place of its parts.
  /// Requires: objects are pinned, and a row names this one.
  Status Settle(const std::string& id, const StoredObject& whole);

  Result<UploadCounts> Count();
  /// The most bytes of an upload.
  [[nodiscard]] std::int64_t most_bytes() const { return options_.bounds.each; }

 private:
  [[nodiscard]] std::int64_t KeepMs() const { return options_.keep_seconds * 1000; }

  UploadStores stores_;
  UploadOptions options_;
};

}  // namespace farhorizon
