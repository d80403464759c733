#pragma once

#include <vector>

namespace farhorizon {

/// In which order the posts of a straight run of heights go: for each the share of all posts that
/// has gone when it goes, above 1 for the two ends, which stay.
///
/// The post goes first whose going adds least to the sum of squares [Visvalingam93, with squares
/// for areas], times a weight: lines that cut a corner, or graze the side at a summit of it, have
/// their skyline there. Ties: the post of lower index.
/// Cost: O(m log m) and the posts between neighbours; O(m^2) on a flat run.
std::vector<double> RankRun(const std::vector<double>& heights);

/// Heights at the posts `staying` (rising, with both ends) between which straight lines come
/// nearest to all heights, in the sum of squares; the ends keep theirs. Cost: O(m).
std::vector<double> FitRun(const std::vector<double>& heights,
                           const std::vector<std::size_t>& staying);

}  // namespace farhorizon
