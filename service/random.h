#pragma once

#include <array>

namespace farhorizon {

/// 16 bytes of the kernel's random generator, enough for an identifier that nobody guesses.
std::array<unsigned char, 16> RandomBytes();

}  // namespace farhorizon
