#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "core/base/result.h"
#include "service/s3/s3_client.h"

namespace farhorizon {

/// The keys of a store in a bucket: those that begin with the location's prefix, which stands in
/// no name here. On S3 an object appears whole, at the end of a PUT or of CompleteMultipartUpload,
/// and whoever reads it has the old bytes or the new ones [S3].
/// Threads: safe. Errors of all calls: those of S3Client::Send, and what is said.
class S3Bucket {
 public:
  S3Bucket(S3Location location, S3Credentials& credentials)
      : client_(std::move(location), credentials) {}

  /// Stores a small text.
  Status PutText(const std::string& key, const std::string& text);
  /// Stores a small text where there is none; false where there is one. Of a server that knows no
  /// conditional PUT it may replace one, and is true.
  Result<bool> PutNewText(const std::string& key, const std::string& text);
  /// Whether a small text can be stored now: asks once, and waits for two seconds at most.
  Status TryPutText(const std::string& key, const std::string& text);
  /// Errors: kNotFound.
  Result<std::string> GetText(const std::string& key);

  /// Stores the first `bytes` of an open file: in one PUT, or, from kLargestPut on, in parts,
  /// which are given up where one fails. Parts of a process that was killed stay until the bucket's
  /// rule removes them.
  Status PutFile(const std::string& key, int fd, std::int64_t bytes);
  /// Writes the object's bytes to the open file, from its start; the file is cut first. It may end
  /// with other bytes than were stored: compare their sum. Errors: kNotFound; kIo.
  Status GetFile(const std::string& key, int fd);

  /// Copies an object of at most 5 GB within the bucket. Errors: kNotFound.
  Status Copy(const std::string& from, const std::string& to);
  /// Succeeds also where there is none.
  Status Delete(const std::string& key);
  /// The same for many, a thousand with a request.
  Status DeleteAll(const std::vector<std::string>& keys);
  /// What follows `folder` in the keys that begin with it. Cost: a request for a thousand.
  Result<std::vector<std::string>> List(const std::string& folder);

  [[nodiscard]] const S3Location& location() const { return client_.location(); }

 private:
  [[nodiscard]] std::string Key(const std::string& name) const {
    return client_.location().prefix + name;
  }
  /// The answer that is a 200. Errors: kNotFound where there is no such key.
  Result<S3Answer> Ask(const S3Request& request);
  /// The same where no more is wanted of it.
  Status Do(const S3Request& request);
  Status PutParts(const std::string& key, int fd, std::int64_t bytes);
  Result<std::string> PutEachPart(S3Request request, const std::string& upload, int fd,
                                  std::int64_t bytes);

  S3Client client_;
};

}  // namespace farhorizon
