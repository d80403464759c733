#pragma once

#include <span>
#include <string>

namespace farhorizon {

/// Two lower-case hexadecimal digits for each byte.
std::string ToHex(std::span<const unsigned char> bytes);

/// True for 0 to 9 and a to f.
bool IsLowerHexDigit(char c);

}  // namespace farhorizon
