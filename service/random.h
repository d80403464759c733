#pragma once

#include <array>
#include <chrono>
#include <cstdint>

namespace farhorizon {

/// 16 bytes of the kernel's random generator, enough for an identifier that nobody guesses.
std::array<unsigned char, 16> RandomBytes();

/// A random time from 0 up to a bound that is `first` and doubles each of `doublings` times, to
/// `longest` at most ("full jitter"): what one fault has stopped does not come back at one time.
std::chrono::milliseconds RandomDelay(std::chrono::milliseconds first,
                                      std::chrono::milliseconds longest, std::int64_t doublings);

}  // namespace farhorizon
