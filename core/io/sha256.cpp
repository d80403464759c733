// A system without SHA-256 is a bug of this program's installation (Check).
#include "core/io/sha256.h"

#include <algorithm>
#include <charconv>

#include <openssl/crypto.h>
#include <openssl/evp.h>
#include <openssl/hmac.h>

#include "core/base/hex.h"
#include "core/base/result.h"
#include "core/io/base64.h"

namespace farhorizon {

std::optional<Digest> Digest::FromHex(std::string_view hex) {
  if (hex.size() != 2 * kBytes || !std::all_of(hex.begin(), hex.end(), IsLowerHexDigit)) {
    return std::nullopt;
  }
  std::array<std::uint8_t, kBytes> bytes{};
  for (std::size_t i = 0; i < kBytes; ++i) {
    const char* digits = hex.data() + 2 * i;
    std::from_chars(digits, digits + 2, bytes[i], 16);
  }
  return Digest(bytes);
}

std::string Digest::Hex() const { return ToHex(bytes_); }

std::string Digest::Base64() const { return ToBase64(bytes_); }

bool SameDigest(const Digest& a, const Digest& b) {
  return CRYPTO_memcmp(a.bytes_.data(), b.bytes_.data(), Digest::kBytes) == 0;
}

Sha256::Sha256()
    : sum_([] {
        std::optional<Checksum> sum = Checksum::Named("sha256");
        Check(sum.has_value(), "SHA-256 is there");
        return *std::move(sum);
      }()) {}

Digest Sha256::Finish() {
  const std::string sum = sum_.Finish();
  std::array<std::uint8_t, Digest::kBytes> bytes{};
  std::copy_n(sum.begin(), bytes.size(), bytes.begin());
  return Digest(bytes);
}

std::string Sha256Hex(std::string_view bytes) {
  Sha256 sum;
  sum.Add(bytes);
  return sum.Finish().Hex();
}

Digest HmacSha256(std::string_view key, std::string_view bytes) {
  std::array<std::uint8_t, Digest::kBytes> code{};
  unsigned int size = 0;
  const auto* data = reinterpret_cast<const unsigned char*>(bytes.data());
  Check(HMAC(EVP_sha256(), key.data(), static_cast<int>(key.size()), data, bytes.size(),
             code.data(), &size) != nullptr &&
            size == code.size(),
        "HMAC ends");
  return Digest(code);
}

}  // namespace farhorizon
