#include "service/auth/api_key.h"

#include <algorithm>
#include <utility>

#include "core/base/hex.h"
#include "service/random.h"

namespace farhorizon {

namespace {

// What a secret scanner knows a key by.
constexpr std::string_view kPrefix = "fh_";
constexpr std::size_t kIdDigits = 12;
constexpr std::size_t kSecretDigits = 64;
constexpr std::size_t kLongestName = 100;

bool IsHex(std::string_view text) { return std::all_of(text.begin(), text.end(), IsLowerHexDigit); }

}  // namespace

NewKey MakeKey(std::string name, Scopes scopes, std::int64_t now_ms) {
  const std::string id = ToHex(RandomBytes()).substr(0, kIdDigits);
  const std::string secret = ToHex(RandomBytes()) + ToHex(RandomBytes());
  std::string text = std::string(kPrefix) + id + "_" + secret;
  Sha256 sum;
  sum.Add(text);
  return {{id, id, std::move(name), scopes, sum.Finish(), now_ms}, std::move(text)};
}

std::optional<std::string> IdOfKey(std::string_view text) {
  constexpr std::size_t kIdEnd = kPrefix.size() + kIdDigits;
  if (text.size() != kIdEnd + 1 + kSecretDigits || text.substr(0, kPrefix.size()) != kPrefix ||
      text[kIdEnd] != '_' || !IsHex(text.substr(kIdEnd + 1))) {
    return std::nullopt;
  }
  const std::string_view id = text.substr(kPrefix.size(), kIdDigits);
  if (!IsHex(id)) return std::nullopt;
  return std::string(id);
}

bool IsKeyId(std::string_view text) { return text.size() == kIdDigits && IsHex(text); }

Status CheckKeyName(std::string_view name) {
  const bool control = std::any_of(name.begin(), name.end(), [](char c) {
    return static_cast<unsigned char>(c) < 0x20 || c == 0x7F;
  });
  if (!name.empty() && name.size() <= kLongestName && !control) return Ok{};
  return Error{ErrorCode::kInvalidArgument,
               "a key's name has 1 to 100 bytes, and no control characters"};
}

}  // namespace farhorizon
