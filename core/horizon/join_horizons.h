#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "core/base/result.h"
#include "core/base/run_control.h"
#include "core/geometry/segment.h"

namespace farhorizon {

/// Indices, rising, of the segments that attain the greatest height of all of them on a set of plan
/// lines with interior points: definition D2 without its crease rule, which needs the faces.
///
/// For any sets A and B, horizon(A u B) = horizon(horizon(A) u horizon(B)) (core/horizon/README.md,
/// theorem 3). So regions can be swept apart and joined in any order. Segments may be in both sets;
/// equal segments are both kept. An edge on the seam of two tiles has one face in each: the caller
/// must know whether it is a crease of the whole.
/// Requires: no segment is a point in plan; x in [0, columns), y in [0, rows), |z| < 2^30.
/// Errors: kCancelled. Cost: a query (occluder_set.h) for each segment.
Result<std::vector<std::size_t>> FindHorizonSegments(const std::vector<Segment>& segments,
                                                     std::int32_t columns, std::int32_t rows,
                                                     const RunControl& control);

/// horizon(a u b), where each set is a horizon already or not; equal segments once, by rising ends.
/// Requires and errors: those of FindHorizonSegments.
Result<std::vector<Segment>> JoinHorizons(std::vector<Segment> a, const std::vector<Segment>& b,
                                          std::int32_t columns, std::int32_t rows,
                                          const RunControl& control);

}  // namespace farhorizon
