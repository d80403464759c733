#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "core/base/result.h"
#include "core/io/sha256.h"
#include "service/auth/scope.h"

namespace farhorizon {

/// A key as it is kept: its text is not, only the SHA-256 of it.
///
/// The text is "fh_ID_SECRET", whose secret is 256 random bits. A slow and salted hash keeps
/// people's passwords from being guessed one after the other; nobody guesses one of 2^256, and
/// each request pays for the hash. So SHA-256 is right here.
struct ApiKey {
  std::string id;     ///< twelve hexadecimal digits; no secret
  std::string owner;  ///< whose jobs it sees: the id of its owner's first key
  std::string name;   ///< for people
  Scopes scopes;
  Digest digest;  ///< of the text
  std::int64_t created_ms = 0;
  std::optional<std::int64_t> expires_ms = {};
  std::optional<std::int64_t> revoked_ms = {};

  [[nodiscard]] bool IsLive(std::int64_t now_ms) const {
    return !revoked_ms && (!expires_ms || now_ms < *expires_ms);
  }
};

/// A key that was just made, the one time that its text is known.
struct NewKey {
  ApiKey key;
  std::string text;
};
/// Makes a key, its own owner. name: as CheckKeyName takes it.
NewKey MakeKey(std::string name, Scopes scopes, std::int64_t now_ms);

/// The id in a key's text; nullopt for a text of any other form.
std::optional<std::string> IdOfKey(std::string_view text);
/// True for twelve hexadecimal digits in lower case.
bool IsKeyId(std::string_view text);
/// A name is shown on terminals and in lists: 1 to 100 bytes, none a control character.
/// Errors: kInvalidArgument.
Status CheckKeyName(std::string_view name);

}  // namespace farhorizon
