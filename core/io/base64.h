#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>

namespace farhorizon {

/// `bytes` in base64 [RFC 4648], padded, without line breaks.
std::string ToBase64(std::span<const unsigned char> bytes);

/// Undoes base64 [RFC 4648] piece by piece. Blanks and line breaks between the characters are
/// passed over, as mail has them, and the padding at the end may be missing; nothing else may.
class Base64Decoder {
 public:
  /// Appends what the next piece of the text stands for to `bytes`; false if it is no base64.
  [[nodiscard]] bool Feed(std::string_view text, std::string& bytes);
  /// Whether the text may end here.
  [[nodiscard]] bool MayEnd() const;

 private:
  std::uint32_t bits_ = 0;   // of the group of four characters that is not complete
  unsigned characters_ = 0;  // of that group
  unsigned padding_ = 0;     // the signs = so far
};

}  // namespace farhorizon
