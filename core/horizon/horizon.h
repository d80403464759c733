#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "core/base/progress.h"
#include "core/base/result.h"
#include "core/horizon/line_height.h"
#include "core/horizon/skyline.h"
#include "core/terrain/terrain.h"

namespace farhorizon {

/// An edge of the terrain that lies on the distant horizon of some horizontal line of sight, with
/// one such line. witness.t runs from a to b.
struct HorizonEdge {
  Edge edge;
  Witness witness;
  bool undecided = false;  ///< kept because the work budget ran out: the witness says nothing
};

/// What the sweep met, for report.json.
struct HorizonStatistics {
  std::int64_t terrain_edges = 0;
  std::int64_t candidates = 0;    ///< edges that the culls left to be decided
  std::int64_t peaks = 0;         ///< local maxima, a level top counting once for each of its posts
  std::int64_t clusters_max = 0;  ///< most merged hulls that were apart at any level
  std::int64_t births = 0;        ///< peaks outside every merged hull
  std::int64_t merges = 0;        ///< merges of two clusters
  std::int64_t regular = 0;       ///< posts that are no peak, saddle or minimum
  std::int64_t saddles = 0;       ///< posts at which separate ground joins
  std::int64_t minima = 0;        ///< posts with no lower neighbour
  std::int64_t hull_changes =
      0;  ///< posts that enlarged a hull; kinetic: failures of hull certificates
  std::int64_t bitangents = 0;   ///< kinetic: failures of bitangent certificates
  std::int64_t queue_max = 0;    ///< kinetic: most events pending
  std::int64_t undecided = 0;    ///< edges kept undecided; more than 0: the set is a superset
  std::int64_t work_budget = 0;  ///< that was in force, in decisions
  PredicateCounts predicates;
};

/// The level at which each post disappears inside a merged hull, and in which one: a bound from
/// below on the height of the visual hull, good for a quick and certain "hidden".
class HullForest {
 public:
  /// True only if every line of sight that crosses the segment between posts u and w meets ground at
  /// or above `level`: at the segment's greatest height, the segment may stand in any mesh without
  /// raising the skyline. False: not known.
  [[nodiscard]] bool Hides(VertexId u, VertexId w, std::int32_t level) const;

  std::vector<std::int32_t> covered_level;  ///< per post; kNoHeight where never
  std::vector<std::int32_t> cluster;        ///< per post: node of the forest it was covered by; -1
  std::vector<std::int32_t> parent;         ///< per node: the node it merged into; -1 at a root
  std::vector<std::int32_t> merge_level;    ///< per node: the level at which it did
};

struct Horizon {
  std::vector<HorizonEdge> edges;  ///< by rising (a, b)
  /// For the edge i those from screen_ends[i - 1] (0 for the first) up to screen_ends[i]: segments that
  /// do not rise above the skyline and hide much of what the edge cannot see. They only save time.
  std::vector<Segment> screens;
  std::vector<std::size_t> screen_ends;
  HorizonStatistics statistics;
  HullForest hulls;
};

/// The algorithm that finds the edges. Both find the same ones; kKinetic is the thesis's own
/// (horizon_kinetic.h), has its limits, and asks the adaptive decision for witnesses only: an edge without
/// one is an InternalError. kAuto: kAdaptive, which is the faster one on large terrain.
enum class Engine { kAuto, kAdaptive, kKinetic };

/// What a caller may wish of FindHorizon.
struct HorizonOptions {
  int threads = 1;  ///< never changes the answer
  Engine engine = Engine::kAuto;
  /// Most decisions (as PredicateCounts counts them) to be made about candidates; with the kinetic engine
  /// its own steps instead (horizon_kinetic.h). Unset: DefaultWorkBudget.
  std::optional<std::int64_t> work_budget = std::nullopt;
  /// Where the budget does not suffice, spend it once more on all candidates evenly, and keep those that
  /// are undecided then, marked as such, instead of failing. The set is then a superset of the horizon, with
  /// the same skyline. Where the budget does suffice this changes nothing.
  bool approximate = false;
};

/// 2000 decisions an edge of the terrain, and no less than 10^9 in all: some eighty times what the hardest
/// real DEM known needs. White noise takes n^1.8 in all, n its edges, and outgrows it: the set is 3SUM-hard.
std::int64_t DefaultWorkBudget(std::int64_t terrain_edges);

/// The edges of `terrain` that lie on the distant horizon for at least one line of sight: creases
/// that attain the greatest height over the line on a set of lines with non-empty interior.
///
/// Exact for every terrain but where it is approximate and says so; the same for any `threads`. Every
/// witness is exact.
/// Errors: kCancelled when the watch says stop; kUnsupportedData, kind sight-too-narrow, with an edge
/// that is on the horizon by a line of sight that a witness cannot say (skyline.h);
/// kResourceExhausted, kind work-budget, where the budget does not suffice; those of the kinetic engine.
/// Cost: about O(n log n) on real terrain; a few hundred bytes a candidate, some 20 a post.
Result<Horizon> FindHorizon(const Terrain& terrain, const HorizonOptions& options,
                            const Watch& watch);
inline Result<Horizon> FindHorizon(const Terrain& terrain, int threads, const Watch& watch,
                                   Engine engine = Engine::kAuto) {
  return FindHorizon(terrain, HorizonOptions{.threads = threads, .engine = engine}, watch);
}

/// The greatest height of the terrain over the plan line through `witness` on `edge` is at the
/// witness: a check from the heights alone, independent of how the witness was found. Exact for every
/// double t in [0, 1] and |dc|, |dr| < 2^62; others, and a witness that is not `exact`, do not hold.
/// Cost: O(columns + rows).
bool WitnessHolds(const Terrain& terrain, Edge edge, const Witness& witness);

}  // namespace farhorizon
