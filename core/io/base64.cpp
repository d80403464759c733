#include "core/io/base64.h"

#include <algorithm>

#include <openssl/evp.h>

namespace farhorizon {

std::string ToBase64(std::span<const unsigned char> bytes) {
  // EVP_EncodeBlock counts in int, and pads at the end of each call: whole groups of three bytes
  // but for the last piece.
  constexpr std::size_t kPiece = std::size_t{3} << 20;
  std::string text;
  for (std::size_t at = 0; at < bytes.size(); at += kPiece) {
    const std::span<const unsigned char> piece =
        bytes.subspan(at, std::min(kPiece, bytes.size() - at));
    // Four characters for each three bytes, and EVP_EncodeBlock's zero byte after them.
    std::string part((piece.size() + 2) / 3 * 4 + 1, '\0');
    const int size = EVP_EncodeBlock(reinterpret_cast<unsigned char*>(part.data()), piece.data(),
                                     static_cast<int>(piece.size()));
    text.append(part, 0, static_cast<std::size_t>(size));
  }
  return text;
}

}  // namespace farhorizon
