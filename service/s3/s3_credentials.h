#pragma once

#include <ctime>
#include <filesystem>
#include <map>
#include <mutex>
#include <optional>
#include <string>

#include "core/base/result.h"

namespace farhorizon {

/// What a request is signed with. Never to be printed, logged or handed to a worker.
struct S3Keys {
  std::string id;
  std::string secret;
  std::string token;  ///< of temporary keys; else empty
};

/// Where the keys are from: the file that is named; else AWS_ACCESS_KEY_ID,
/// AWS_SECRET_ACCESS_KEY and AWS_SESSION_TOKEN; else the file AWS_SHARED_CREDENTIALS_FILE. A file
/// is as Amazon's programs write it, with a section in brackets for AWS_PROFILE ("default") and
/// lines aws_access_key_id = …; it is read again whenever it has changed, so that keys can be
/// replaced while the service runs.
/// Threads: safe.
class S3Credentials {
 public:
  S3Credentials(std::filesystem::path file, std::map<std::string, std::string> environment);

  /// Errors: kInvalidArgument "invalid-config" where there are none, with where they may be.
  Result<S3Keys> Current();

 private:
  std::filesystem::path file_;
  std::map<std::string, std::string> environment_;
  std::mutex mutex_;
  std::optional<S3Keys> read_;  ///< of the file as it was
  timespec modified_{};
};

}  // namespace farhorizon
