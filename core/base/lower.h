#pragma once

#include <algorithm>
#include <string>

namespace farhorizon {

/// `text` in small letters, those of ASCII, whatever the locale.
inline std::string Lower(std::string text) {
  std::ranges::transform(text, text.begin(), [](char c) {
    return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
  });
  return text;
}

}  // namespace farhorizon
