#include "core/geo/short_text.h"

#include <algorithm>

namespace farhorizon {

std::string ShortText(const std::string& text, std::size_t bytes) {
  std::size_t end = std::min(bytes, text.size());
  // Back to the first byte of a character.
  while (end > 0 && end < text.size() && (static_cast<unsigned char>(text[end]) & 0xC0) == 0x80) {
    --end;
  }
  std::string shown = text.substr(0, end);
  for (char& c : shown) {
    if (static_cast<unsigned char>(c) < 0x20) c = ' ';
  }
  return end < text.size() ? shown + "..." : shown;
}

}  // namespace farhorizon
