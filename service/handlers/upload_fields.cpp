#include "service/handlers/upload_fields.h"

#include <algorithm>
#include <charconv>
#include <map>
#include <string_view>
#include <utility>

#include "core/io/base64.h"
#include "service/handlers/problem.h"

namespace farhorizon {

namespace {

constexpr std::size_t kMostMetadata = 4096;
// More than any file has; more digits are as good.
constexpr std::int64_t kMostNumber = 1'000'000'000'000'000'000;
constexpr std::size_t kNumberDigits = 18;

Result<std::int64_t> ReadNumber(const char* name, const std::string& text) {
  if (text.empty() || text.find_first_not_of("0123456789") != std::string::npos) {
    return InvalidUpload(std::string(name) + " must be a number of bytes, 0 or more");
  }
  const std::string digits = text.substr(std::min(text.find_first_not_of('0'), text.size() - 1));
  if (digits.size() > kNumberDigits) return kMostNumber;
  std::int64_t number = 0;
  std::from_chars(digits.data(), digits.data() + digits.size(), number);
  return number;
}

// Text that may stand in JSON and in logs.
bool IsPlain(const std::string& text) {
  return std::none_of(text.begin(), text.end(),
                      [](char c) { return (c >= 0 && c < ' ') || c == 0x7F; });
}

bool IsAscii(const std::string& text) {
  return std::all_of(text.begin(), text.end(), [](char c) { return c >= 0; });
}

// One pair of a key and its value in base64, which may be missing.
Result<std::pair<std::string, std::string>> ReadPair(std::string_view pair) {
  const std::size_t blank = std::min(pair.find(' '), pair.size());
  std::string key(pair.substr(0, blank));
  const std::string_view coded = Trimmed(pair.substr(blank));
  if (key.empty()) return InvalidUpload("a key of Upload-Metadata is empty");
  std::string value;
  Base64Decoder decoder;
  if (coded.find_first_of(" \t") != std::string_view::npos || !decoder.Feed(coded, value) ||
      !decoder.MayEnd()) {
    return InvalidUpload("a value of Upload-Metadata is no base64; write KEY BASE64,KEY BASE64");
  }
  if (!IsPlain(value)) return InvalidUpload("a value of Upload-Metadata has control characters");
  return std::pair(std::move(key), std::move(value));
}

std::string FirstOf(const std::map<std::string, std::string>& values, const char* name,
                    const char* other) {
  for (const char* key : {name, other}) {
    const auto found = values.find(key);
    if (found != values.end() && !found->second.empty()) return found->second;
  }
  return "";
}

}  // namespace

Error InvalidUpload(const std::string& why) {
  return {ErrorCode::kInvalidArgument, why, "invalid-upload"};
}

std::optional<HttpResponse> RefuseTusVersion(const HttpRequest& request) {
  const std::string* version = request.Header("tus-resumable");
  if (version != nullptr && *version == kTusVersion) return std::nullopt;
  HttpResponse response = ProblemResponse(
      request, {"unsupported-tus-version", std::string("uploads speak tus ") + kTusVersion +
                                               "; send the field Tus-Resumable: " + kTusVersion});
  response.Set("Tus-Version", kTusVersion);
  return response;
}

Result<std::optional<std::int64_t>> ReadUploadLength(const HttpRequest& request) {
  const std::string* field = request.Header("upload-length");
  if (field == nullptr) return std::optional<std::int64_t>();
  Result<std::int64_t> length = ReadNumber("Upload-Length", *field);
  if (!length) return std::move(length.error());
  return std::optional<std::int64_t>(*length);
}

Result<std::optional<std::int64_t>> ReadNewUploadLength(const HttpRequest& request) {
  Result<std::optional<std::int64_t>> length = ReadUploadLength(request);
  if (!length) return length;
  const std::string* defer = request.Header("upload-defer-length");
  if (defer != nullptr && *defer != "1") return InvalidUpload("Upload-Defer-Length must be 1");
  if ((defer != nullptr) != length->has_value()) return length;
  return InvalidUpload("say how long the upload is by Upload-Length, or Upload-Defer-Length: 1");
}

Result<std::int64_t> ReadUploadOffset(const HttpRequest& request) {
  const std::string* field = request.Header("upload-offset");
  if (field == nullptr) return InvalidUpload("say by Upload-Offset where the bytes begin");
  return ReadNumber("Upload-Offset", *field);
}

Result<UploadMetadata> ReadUploadMetadata(const HttpRequest& request) {
  UploadMetadata metadata;
  const std::string* field = request.Header("upload-metadata");
  if (field == nullptr) return metadata;
  if (field->size() > kMostMetadata) {
    return InvalidUpload("Upload-Metadata has more than " + std::to_string(kMostMetadata) +
                         " bytes");
  }
  metadata.text = *field;
  std::map<std::string, std::string> values;
  for (std::string_view rest = *field; !rest.empty();) {
    const std::size_t comma = std::min(rest.find(','), rest.size());
    Result<std::pair<std::string, std::string>> pair = ReadPair(Trimmed(rest.substr(0, comma)));
    if (!pair) return std::move(pair.error());
    if (!values.insert(*std::move(pair)).second) {
      return InvalidUpload("a key of Upload-Metadata is there twice");
    }
    rest.remove_prefix(std::min(comma + 1, rest.size()));
  }
  metadata.filename = FirstOf(values, "filename", "name");
  metadata.file_type = FirstOf(values, "filetype", "type");
  // A media type has no other characters.
  if (!IsAscii(metadata.file_type)) metadata.file_type.clear();
  return metadata;
}

}  // namespace farhorizon
