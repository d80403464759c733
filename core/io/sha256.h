#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "core/io/checksum.h"

namespace farhorizon {

/// A SHA-256 sum.
class Digest {
 public:
  static constexpr std::size_t kBytes = 32;

  explicit Digest(const std::array<std::uint8_t, kBytes>& bytes) : bytes_(bytes) {}
  /// The inverse of Hex; nullopt for any other text.
  static std::optional<Digest> FromHex(std::string_view hex);

  /// 64 lower-case hexadecimal digits.
  [[nodiscard]] std::string Hex() const;
  /// 44 characters of base64 [RFC 4648], as in the HTTP field Repr-Digest.
  [[nodiscard]] std::string Base64() const;

  friend bool operator==(const Digest&, const Digest&) = default;
  /// The same, in time that does not depend on the bytes: for secrets.
  friend bool SameDigest(const Digest& a, const Digest& b);

 private:
  std::array<std::uint8_t, kBytes> bytes_;
};

/// Computes the SHA-256 of bytes that come piece by piece.
class Sha256 {
 public:
  Sha256();

  void Add(std::string_view bytes) { sum_.Add(bytes); }
  /// Requires: called once, last.
  Digest Finish();

 private:
  Checksum sum_;
};

/// Lower-case hexadecimal SHA-256 of `bytes`.
std::string Sha256Hex(std::string_view bytes);

/// The HMAC of `bytes` with SHA-256 [RFC 2104].
Digest HmacSha256(std::string_view key, std::string_view bytes);

}  // namespace farhorizon
