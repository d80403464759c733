#include "core/io/md5.h"

#include <array>
#include <span>

#include <openssl/evp.h>

#include "core/io/base64.h"

namespace farhorizon {

struct Md5::State {
  EVP_MD_CTX* context = EVP_MD_CTX_new();
  bool good = false;
  State() = default;
  State(const State&) = delete;
  State& operator=(const State&) = delete;
  ~State() { EVP_MD_CTX_free(context); }
};

Md5::Md5() : state_(std::make_unique<State>()) {
  state_->good =
      state_->context != nullptr && EVP_DigestInit_ex(state_->context, EVP_md5(), nullptr) == 1;
}
Md5::~Md5() = default;

void Md5::Add(std::string_view bytes) {
  state_->good = state_->good && EVP_DigestUpdate(state_->context, bytes.data(), bytes.size()) == 1;
}

std::optional<std::string> Md5::Finish() {
  std::array<unsigned char, EVP_MAX_MD_SIZE> bytes{};
  unsigned int size = 0;
  if (!state_->good || EVP_DigestFinal_ex(state_->context, bytes.data(), &size) != 1) {
    return std::nullopt;
  }
  return ToBase64(std::span(bytes).first(size));
}

}  // namespace farhorizon
