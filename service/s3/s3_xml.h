#pragma once

#include <optional>
#include <string>
#include <vector>

namespace farhorizon {

/// An error as S3 words it.
struct S3Fault {
  std::string code;  ///< "NoSuchKey"
  std::string message;
};

/// The error that an answer has; nullopt where it is none. Some come with the status 200.
std::optional<S3Fault> ReadS3Fault(const std::string& body);

/// A page of the keys of a bucket.
struct S3Page {
  std::vector<std::string> keys;
  bool more = false;  ///< whether there are keys behind these
};

/// nullopt where the answer is no list.
std::optional<S3Page> ReadS3Page(const std::string& body);

/// The id of an upload in parts that has begun; empty where the answer has none.
std::string ReadS3UploadId(const std::string& body);

}  // namespace farhorizon
