#pragma once

namespace farhorizon {

/// Square metres: a change that gains less is left out, as rounding decides.
inline constexpr float kLeastGain = 1e-3F;

}  // namespace farhorizon
