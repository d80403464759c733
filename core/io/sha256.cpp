// Wraps OpenSSL's digests. Each call can fail only for want of memory or of the algorithm, neither
// of which a caller could do anything about: that is a bug of this program's installation (Check).
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

struct Sha256::State {
  EVP_MD_CTX* context = EVP_MD_CTX_new();
  State() = default;
  State(const State&) = delete;
  State& operator=(const State&) = delete;
  ~State() { EVP_MD_CTX_free(context); }
};

Sha256::Sha256() : state_(std::make_unique<State>()) {
  Check(
      state_->context != nullptr && EVP_DigestInit_ex(state_->context, EVP_sha256(), nullptr) == 1,
      "SHA-256 starts");
}
Sha256::~Sha256() = default;
Sha256::Sha256(Sha256&&) noexcept = default;
Sha256& Sha256::operator=(Sha256&&) noexcept = default;

void Sha256::Add(std::string_view bytes) {
  Check(EVP_DigestUpdate(state_->context, bytes.data(), bytes.size()) == 1, "SHA-256 goes on");
}

Digest Sha256::Finish() {
  std::array<std::uint8_t, Digest::kBytes> bytes{};
  unsigned int size = 0;
  Check(EVP_DigestFinal_ex(state_->context, bytes.data(), &size) == 1 && size == bytes.size(),
        "SHA-256 ends");
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
