#pragma once

#include <chrono>
#include <map>
#include <mutex>
#include <string>

#include "core/base/result.h"
#include "service/s3/s3_credentials.h"
#include "service/s3/s3_location.h"
#include "service/s3/s3_transfer.h"

namespace farhorizon {

/// Sends requests again, after a random pause, where the storage is busy, fails or is out of reach:
/// four times at most, and not after fifteen seconds. Where that was in vain it is asked by one
/// request at a time and all others fail at once, until it answers: a storage that stands still
/// would else hold every thread that asks for an object.
/// Threads: safe.
class S3Client {
 public:
  S3Client(S3Location location, S3Credentials& credentials);

  /// An answer that is a 2xx, or a 404, 409 or 412 with its code in `body`.
  /// Errors: kIo "storage", with cause and remedy: out of reach, 5xx, keys refused, no such bucket.
  Result<S3Answer> Send(const S3Request& request);

  [[nodiscard]] const S3Location& location() const { return location_; }

 private:
  Result<S3Answer> SendOften(const S3Request& request, int tries);
  /// What an answer that is no success means, in words with the remedy.
  [[nodiscard]] Error ErrorOf(const S3Request& request, const S3Answer& answer) const;
  /// How often a request may be tried now: 0 while another one finds out whether it has sense.
  int TriesNow(const S3Request& request);
  void Note(bool answers);

  const S3Location location_;
  S3Credentials& credentials_;
  S3Transfer transfer_;
  std::mutex mutex_;
  bool silent_ = false;
  std::chrono::steady_clock::time_point next_try_;
};

}  // namespace farhorizon
