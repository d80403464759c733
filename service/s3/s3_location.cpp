#include "service/s3/s3_location.h"

#include <algorithm>
#include <initializer_list>
#include <string_view>
#include <unistd.h>

namespace farhorizon {

namespace {

constexpr std::string_view kScheme = "s3://";
constexpr const char* kFirstRegion = "us-east-1";  // which servers without regions call theirs, too

Error Invalid(const std::string& why) {
  return {ErrorCode::kInvalidArgument, why, "invalid-config"};
}

bool Consists(std::string_view text, std::string_view of_beside_letters_and_digits) {
  return std::all_of(text.begin(), text.end(), [&](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') ||
           of_beside_letters_and_digits.find(c) != std::string_view::npos;
  });
}

bool IsBucket(const std::string& name) {
  const bool lower =
      std::none_of(name.begin(), name.end(), [](char c) { return c >= 'A' && c <= 'Z'; });
  return name.size() >= 3 && name.size() <= 63 && lower && Consists(name, ".-") &&
         Consists(name.substr(0, 1), "") && Consists(name.substr(name.size() - 1), "");
}

// No part is empty, '.' or '..', which a URL would lose.
bool IsPrefix(const std::string& prefix) {
  const std::string framed = "/" + prefix;
  return prefix.size() <= 512 && Consists(prefix, "._-/") &&
         framed.find("//") == std::string::npos && framed.find("/./") == std::string::npos &&
         framed.find("/../") == std::string::npos;
}

std::string FirstOf(const std::string& given, const std::map<std::string, std::string>& environment,
                    std::initializer_list<const char*> names) {
  if (!given.empty()) return given;
  for (const char* name : names) {
    const auto found = environment.find(name);
    if (found != environment.end() && !found->second.empty()) return found->second;
  }
  return "";
}

bool IsEndpoint(const std::string& url) {
  for (const std::string scheme : {"http://", "https://"}) {
    if (url.rfind(scheme, 0) != 0) continue;
    const std::string host = url.substr(scheme.size());
    return !host.empty() && Consists(host, ".-:[]_");
  }
  return false;
}

}  // namespace

std::map<std::string, std::string> AwsEnvironment() {
  std::map<std::string, std::string> variables;
  for (char** entry = environ; *entry != nullptr; ++entry) {
    const std::string_view text(*entry);
    const std::size_t equals = text.find('=');
    if (text.rfind("AWS_", 0) != 0 || equals == std::string_view::npos) continue;
    variables.emplace(text.substr(0, equals), text.substr(equals + 1));
  }
  return variables;
}

bool IsS3Url(const std::string& text) { return text.rfind(kScheme, 0) == 0; }

Result<S3Location> ReadS3Location(const std::string& url, const S3Options& options,
                                  const std::map<std::string, std::string>& environment) {
  S3Location location;
  const std::string rest = IsS3Url(url) ? url.substr(kScheme.size()) : "";
  const std::size_t slash = std::min(rest.find('/'), rest.size());
  location.bucket = rest.substr(0, slash);
  if (slash < rest.size()) location.prefix = rest.substr(slash + 1);
  if (!location.prefix.empty() && location.prefix.back() != '/') location.prefix += '/';
  if (!IsBucket(location.bucket) || !IsPrefix(location.prefix)) {
    return Invalid("\"" + url +
                   "\" names no bucket: give s3://BUCKET or s3://BUCKET/PREFIX, BUCKET of 3 to 63 "
                   "lower-case letters, digits, '.' and '-', PREFIX of letters, digits and ._-/");
  }
  location.region = FirstOf(options.region, environment, {"AWS_REGION", "AWS_DEFAULT_REGION"});
  if (location.region.empty()) location.region = kFirstRegion;
  if (!Consists(location.region, "-_") || location.region.size() > 64) {
    return Invalid("\"" + location.region + "\" is no region: give one like eu-central-1");
  }
  std::string endpoint =
      FirstOf(options.endpoint, environment, {"AWS_ENDPOINT_URL_S3", "AWS_ENDPOINT_URL"});
  const bool at_amazon = endpoint.empty();
  if (at_amazon) endpoint = "https://s3." + location.region + ".amazonaws.com";
  while (endpoint.back() == '/') endpoint.pop_back();
  if (!IsEndpoint(endpoint)) {
    return Invalid("\"" + endpoint +
                   "\" is no endpoint of S3-compatible storage: give http://HOST[:PORT] or "
                   "https://HOST[:PORT], without a path or a user");
  }
  // A certificate for *.s3.amazonaws.com is for no name with a further dot.
  const bool dots = location.bucket.find('.') != std::string::npos;
  const bool in_host = options.addressing == S3Addressing::kHost ||
                       (options.addressing == S3Addressing::kAuto && at_amazon && !dots);
  if (in_host) {
    endpoint.insert(endpoint.find("://") + 3, location.bucket + ".");
    location.url = endpoint + "/";
  } else {
    location.url = endpoint + "/" + location.bucket + "/";
  }
  return location;
}

}  // namespace farhorizon
