#include "core/io/base64.h"

#include <algorithm>

#include <openssl/evp.h>

namespace farhorizon {

namespace {

// The six bits that a character stands for; -1 for one that stands for none.
int BitsOf(char c) {
  if (c >= 'A' && c <= 'Z') return c - 'A';
  if (c >= 'a' && c <= 'z') return c - 'a' + 26;
  if (c >= '0' && c <= '9') return c - '0' + 52;
  if (c == '+') return 62;
  return c == '/' ? 63 : -1;
}

}  // namespace

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

bool Base64Decoder::Feed(std::string_view text, std::string& bytes) {
  for (const char c : text) {
    if (c == ' ' || c == '\t' || c == '\r' || c == '\n') continue;
    if (c == '=') {
      ++padding_;
      if (characters_ < 2 || characters_ + padding_ > 4) return false;
      continue;
    }
    const int bits = BitsOf(c);
    if (bits < 0 || padding_ > 0) return false;
    bits_ = bits_ << 6U | static_cast<std::uint32_t>(bits);
    ++characters_;
    // The first character of a group gives no byte, each further one gives one.
    if (characters_ > 1) bytes += static_cast<char>(bits_ >> (8U - 2U * characters_) & 0xFFU);
    characters_ %= 4;
  }
  return true;
}

bool Base64Decoder::MayEnd() const {
  return characters_ != 1 && (padding_ == 0 || characters_ + padding_ == 4);
}

}  // namespace farhorizon
