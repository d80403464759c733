#pragma once

#include <span>
#include <vector>

#include <boost/multiprecision/cpp_int.hpp>

#include "core/horizon/lines_of_sight/upper_envelope.h"

namespace farhorizon {

/// Exact numbers, of any size.
using Number = boost::multiprecision::number<boost::multiprecision::cpp_rational_backend,
                                             boost::multiprecision::et_off>;

/// A part of the upper envelope, places in exact numbers.
struct SeenStretch {
  std::size_t segment = 0;
  Number from;
  Number to;
  friend bool operator==(const SeenStretch&, const SeenStretch&) = default;
};

/// What UpperEnvelope says, plainly by its definition: between any two neighbouring places at which
/// a segment ends or two cross, in height or in depth, the best segment at the middle. Exact. Cost:
/// O(n^3).
std::vector<SeenStretch> SkylineByDefinition(std::span<const Segment> segments,
                                             const ViewDirection& view);

}  // namespace farhorizon
