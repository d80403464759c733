#pragma once

#include <cstddef>
#include <vector>

#include "core/base/progress.h"
#include "core/base/result.h"
#include "core/horizon/visibility/occluder_set.h"

namespace farhorizon {

/// Indices, rising, of the segments that attain the greatest height of all of them over a set of plan
/// lines with non-empty interior: definition D2 without its crease rule, which needs the faces.
///
/// For any sets A and B, horizon(A u B) = horizon(horizon(A) u horizon(B)): regions are swept part by
/// part, and what is left is put together in any order (horizon.md, theorem 3; segments may stand in
/// both, equal ones are both kept). An edge on the seam of two tiles has one face in each: whether it
/// is a crease of the whole is for the caller to know.
/// Requires: no segment is a point in plan; x in [0, columns), y in [0, rows), |z| < 2^30.
/// Errors: kCancelled. Cost: a sight (occluder_set.h) for each segment.
Result<std::vector<std::size_t>> FindHorizonSegments(const std::vector<Segment>& segments,
                                                     std::int32_t columns, std::int32_t rows,
                                                     const Watch& watch);

/// horizon(a u b), of sets that are horizons already or not; equal segments once, by rising ends.
/// Requires and errors: those of FindHorizonSegments.
Result<std::vector<Segment>> JoinHorizons(std::vector<Segment> a, const std::vector<Segment>& b,
                                          std::int32_t columns, std::int32_t rows,
                                          const Watch& watch);

}  // namespace farhorizon
