#include "service/handlers/content_digest.h"

#include <algorithm>
#include <utility>

namespace farhorizon {

namespace {

constexpr std::size_t kDigestChars = 44;  // of 32 bytes in base64

Error Mismatch(const std::string& why) {
  return {ErrorCode::kInvalidArgument, why, "digest-mismatch"};
}

}  // namespace

Result<ContentDigest> ContentDigest::Of(const HttpRequest& request) {
  ContentDigest digest;
  const std::string* field = request.Header("content-digest");
  if (field == nullptr) return digest;
  // A dictionary of byte sequences [RFC 8941]: sha-256=:BASE64:, sha-512=:BASE64:
  std::string_view rest(*field);
  while (!rest.empty()) {
    const std::size_t comma = std::min(rest.find(','), rest.size());
    const std::string_view member = Trimmed(rest.substr(0, comma));
    rest.remove_prefix(std::min(comma + 1, rest.size()));
    const std::size_t equals = member.find("=:");
    if (equals == std::string_view::npos || member.size() < equals + 3 || member.back() != ':') {
      return Mismatch("the Content-Digest cannot be read; write sha-256=:BASE64:");
    }
    if (member.substr(0, equals) != "sha-256") continue;
    const std::string_view value = member.substr(equals + 2, member.size() - equals - 3);
    if (value.size() != kDigestChars) {
      return Mismatch("the Content-Digest's sha-256 is not 32 bytes in base64");
    }
    digest.expected_ = value;
    digest.hash_.emplace();
  }
  return digest;
}

void ContentDigest::Add(std::string_view piece) {
  if (hash_) hash_->Add(piece);
}

Status ContentDigest::Check() {
  if (!hash_ || hash_->Finish().Base64() == *expected_) return Ok{};
  return Mismatch("the body is not the one that Content-Digest says; send it again");
}

}  // namespace farhorizon
