#pragma once

#include <cstdint>

#include "core/exact/predicate_counts.h"

namespace farhorizon {

/// Counts of the search, for report.json, which has these names. A *cluster* is a merged hull.
/// What the kinetic engine counts differently is noted at the field.
struct HorizonStatistics {
  std::int64_t terrain_edges = 0;
  std::int64_t candidates = 0;    ///< edges that the culls left to be decided
  std::int64_t peaks = 0;         ///< local maxima; of a horizontal summit, each of its posts
  std::int64_t clusters_max = 0;  ///< the most merged hulls at any height
  std::int64_t births = 0;        ///< peaks outside all merged hulls; kinetic: all peaks
  std::int64_t merges = 0;        ///< merges of two clusters
  std::int64_t regular = 0;       ///< posts that are no peak, saddle or minimum
  std::int64_t saddles = 0;       ///< posts at which ground that was apart joins
  std::int64_t minima = 0;        ///< posts with no lower neighbour
  std::int64_t hull_changes = 0;  ///< posts that extended a hull; kinetic: hull certificates failed
  std::int64_t bitangents = 0;    ///< kinetic: bitangent certificates failed
  std::int64_t queue_max = 0;     ///< kinetic: the most events in the queue
  std::int64_t undecided = 0;     ///< edges kept undecided; if not 0, the edges are a superset
  std::int64_t work_budget = 0;   ///< the one in force, in decisions
  PredicateCounts predicates;
};

}  // namespace farhorizon
