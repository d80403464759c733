#pragma once

#include <cstdint>

#include "core/exact/predicate_counts.h"

namespace farhorizon {

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

}  // namespace farhorizon
