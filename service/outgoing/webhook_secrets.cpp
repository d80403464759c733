#include "service/outgoing/webhook_secrets.h"

#include <algorithm>
#include <utility>

#include "core/io/base64.h"
#include "core/io/file.h"
#include "core/io/sha256.h"

namespace farhorizon {

namespace {

constexpr std::string_view kPrefix = "whsec_";
constexpr std::uintmax_t kLargestFile = 65536;
constexpr std::size_t kLeastSecretBytes = 24;
constexpr std::size_t kMostSecretBytes = 64;

Error Unusable(const std::string& why) {
  return {
      ErrorCode::kInvalidArgument,
      "callbacks.secretFile " + why +
          "; it has a secret a line: { printf whsec_; head -c 32 /dev/urandom | base64; } > FILE",
      "invalid-config"};
}

Result<std::vector<std::string>> ReadSecrets(const std::string& file) {
  if (file.empty()) return Unusable("is not set, and callbacks are signed");
  const Result<std::string> text = ReadFile(file, kLargestFile);
  if (!text) return Unusable("cannot be read: " + text.error().message);
  std::vector<std::string> secrets;
  for (std::size_t begin = 0; begin < text->size();) {
    const std::size_t end = std::min(text->find('\n', begin), text->size());
    std::string_view line = std::string_view(*text).substr(begin, end - begin);
    begin = end + 1;
    if (line.ends_with('\r')) line.remove_suffix(1);
    if (line.empty()) continue;
    std::string secret;
    Base64Decoder decoder;
    if (!line.starts_with(kPrefix) || !decoder.Feed(line.substr(kPrefix.size()), secret) ||
        !decoder.MayEnd() || secret.size() < kLeastSecretBytes ||
        secret.size() > kMostSecretBytes) {
      return Unusable("has a line that is not whsec_ and 24 to 64 bytes in base64");
    }
    secrets.push_back(std::move(secret));
  }
  if (secrets.empty()) return Unusable("is empty");
  return secrets;
}

}  // namespace

Result<WebhookSecrets> WebhookSecrets::Open(const std::string& file) {
  Result<std::vector<std::string>> secrets = ReadSecrets(file);
  if (!secrets) return std::move(secrets.error());
  WebhookSecrets opened;
  opened.file_ = file;
  opened.secrets_ = *std::move(secrets);
  return opened;
}

std::string WebhookSecrets::Sign(std::string_view id, std::int64_t unix_seconds,
                                 std::string_view body) const {
  const Result<std::vector<std::string>> now = ReadSecrets(file_);
  std::string said(id);
  said.append(".").append(std::to_string(unix_seconds)).append(".").append(body);
  std::string signatures;
  for (const std::string& secret : now ? *now : secrets_) {
    signatures.append(signatures.empty() ? "v1," : " v1,");
    signatures.append(HmacSha256(secret, said).Base64());
  }
  return signatures;
}

}  // namespace farhorizon
