// Wraps OpenSSL's digests. Once one has started, a call can fail only for want of memory, which a
// caller could do nothing about (Check).
#include "core/io/checksum.h"

#include <array>
#include <utility>

#include <openssl/evp.h>

#include "core/base/result.h"

namespace farhorizon {

struct Checksum::State {
  EVP_MD_CTX* context = EVP_MD_CTX_new();
  State() = default;
  State(const State&) = delete;
  State& operator=(const State&) = delete;
  ~State() { EVP_MD_CTX_free(context); }
};

Checksum::Checksum(std::unique_ptr<State> state) : state_(std::move(state)) {}
Checksum::~Checksum() = default;
Checksum::Checksum(Checksum&&) noexcept = default;
Checksum& Checksum::operator=(Checksum&&) noexcept = default;

std::optional<Checksum> Checksum::Named(std::string_view name) {
  const EVP_MD* algorithm = name == "sha256" ? EVP_sha256()
                            : name == "sha1" ? EVP_sha1()
                            : name == "md5"  ? EVP_md5()
                                             : nullptr;
  if (algorithm == nullptr) return std::nullopt;
  auto state = std::make_unique<State>();
  Check(state->context != nullptr, "there is memory for a checksum");
  if (EVP_DigestInit_ex(state->context, algorithm, nullptr) != 1) return std::nullopt;
  return Checksum(std::move(state));
}

void Checksum::Add(std::string_view bytes) {
  Check(EVP_DigestUpdate(state_->context, bytes.data(), bytes.size()) == 1, "a checksum goes on");
}

std::string Checksum::Finish() {
  std::array<unsigned char, EVP_MAX_MD_SIZE> bytes{};
  unsigned int size = 0;
  Check(EVP_DigestFinal_ex(state_->context, bytes.data(), &size) == 1, "a checksum ends");
  return {bytes.begin(), bytes.begin() + size};
}

}  // namespace farhorizon
