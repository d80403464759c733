#pragma once

#include <chrono>
#include <cstdint>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/result.h"
#include "service/s3/s3_credentials.h"

namespace farhorizon {

/// A part of an open file.
struct FilePart {
  int fd = -1;
  std::int64_t offset = 0;
  std::int64_t bytes = 0;
};

/// One request to S3-compatible storage.
struct S3Request {
  std::string method = "GET";
  std::string key = {};    ///< after the URL of the bucket; empty: the bucket
  std::string query = {};  ///< as it is signed: sorted, escaped, with '=' behind each name
  std::vector<std::string> headers = {};
  std::string body = {};
  std::optional<FilePart> file = {};  ///< in place of `body`
  /// Takes the bytes of a 200, in place of S3Answer::body; false ends the transfer. Called with an
  /// empty piece first, where an attempt begins.
  std::function<bool(std::string_view piece)> sink = {};
  /// For the whole of one attempt; 0: as long as bytes move.
  std::chrono::milliseconds most{8000};
  std::chrono::seconds silence{20};  ///< that an attempt bears before it has stalled
  bool once = false;                 ///< no second attempt, but one in any case
};

/// What the storage has answered.
struct S3Answer {
  int status = 0;  ///< 0: no answer, -1: this machine's own fault; `body` says why
  std::string etag = {};
  std::string body = {};  ///< at most kMostAnswerBytes
};

constexpr std::size_t kMostAnswerBytes = std::size_t{4} << 20U;

/// Sends signed requests, one attempt each, over connections that are kept open. libcurl signs
/// them [SigV4] with the SHA-256 of the body, which the storage compares with what it gets, as it
/// does Content-MD5, which older servers know alone.
/// Threads: safe; each request in flight has a connection.
class S3Transfer {
 public:
  /// url: of the bucket, ends with '/'.
  S3Transfer(std::string url, std::string region);
  ~S3Transfer();
  S3Transfer(const S3Transfer&) = delete;
  S3Transfer& operator=(const S3Transfer&) = delete;

  /// Never waits longer than 3 s for a connection, and than request.silence for bytes.
  S3Answer Attempt(const S3Request& request, const S3Keys& keys);

 private:
  class Handle;
  std::unique_ptr<Handle> Take();

  std::string url_;
  std::string region_;
  std::mutex mutex_;
  std::vector<std::unique_ptr<Handle>> idle_;
};

}  // namespace farhorizon
