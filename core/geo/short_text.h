#pragma once

#include <cstddef>
#include <string>

namespace farhorizon {

/// `text` for a message: at most `bytes` bytes of it, whole characters of UTF-8, "..." where it
/// goes on; blanks for line breaks and other control characters.
std::string ShortText(const std::string& text, std::size_t bytes);

}  // namespace farhorizon
