#pragma once

#include <vector>

namespace farhorizon {

/// A round distance between ticks, about `count` to a range of `size`: 1, 2 or 5 times a power of
/// ten. Requires: both positive.
double TickStep(double size, double count);

/// The multiples of `step` within [least, most]; none where least > most.
std::vector<double> TicksWithin(double least, double most, double step);

}  // namespace farhorizon
