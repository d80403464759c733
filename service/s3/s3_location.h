#pragma once

#include <array>
#include <filesystem>
#include <map>
#include <string>

#include "core/base/result.h"

namespace farhorizon {

/// How a bucket is named in the URL of a request: in its path, or in the name of the host.
enum class S3Addressing { kAuto, kPath, kHost };

/// The names of S3Addressing's values.
inline constexpr std::array kS3AddressingNames = {"auto", "path", "host"};

/// What the configuration says of S3-compatible storage. What is empty is taken from the
/// environment that Amazon's own programs read.
struct S3Options {
  std::string endpoint;  ///< http(s)://HOST[:PORT]; empty: AWS_ENDPOINT_URL_S3, AWS_ENDPOINT_URL,
                         ///< or Amazon's own of the region
  std::string region;    ///< empty: AWS_REGION, AWS_DEFAULT_REGION, us-east-1
  S3Addressing addressing = S3Addressing::kAuto;  ///< auto: the host's name at Amazon, else path
  std::filesystem::path credentials;              ///< a file; empty: see S3Credentials
};

/// Where the objects of a store are: a bucket, and what all keys in it begin with.
struct S3Location {
  std::string bucket;
  std::string prefix;  ///< empty, or ends with '/'
  std::string url;     ///< of the bucket: a key stands behind it; ends with '/'
  std::string region;
};

/// The variables of this process that start with AWS_, which say where and by which right.
std::map<std::string, std::string> AwsEnvironment();

/// True for "s3://…".
bool IsS3Url(const std::string& text);

/// Reads s3://BUCKET[/PREFIX].
/// Errors: kInvalidArgument "invalid-config", with what stands there and what may.
Result<S3Location> ReadS3Location(const std::string& url, const S3Options& options,
                                  const std::map<std::string, std::string>& environment);

}  // namespace farhorizon
