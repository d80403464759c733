#pragma once

#include <span>
#include <string>

namespace farhorizon {

/// `bytes` in base64 [RFC 4648], padded, without line breaks.
std::string ToBase64(std::span<const unsigned char> bytes);

}  // namespace farhorizon
