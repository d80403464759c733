#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "core/base/result.h"
#include "core/base/run_control.h"
#include "core/terrain/terrain.h"

namespace farhorizon {

/// How many events a kinetic sweep had, by kind [Archambault03, section 3.2].
struct EventCounts {
  std::int64_t peak = 0;       ///< posts that begin a hull of their own
  std::int64_t regular = 0;    ///< posts that do none of the others (a peak inside a hull is one)
  std::int64_t saddle = 0;     ///< posts at which separate hulls join
  std::int64_t minimum = 0;    ///< posts all of whose neighbours were met before
  std::int64_t merge = 0;      ///< hulls that became part of another: at saddles and by collision
  std::int64_t hull = 0;       ///< corners in line, and interior points that came out
  std::int64_t inside = 0;     ///< interior points that got another triangle of their hull
  std::int64_t cover = 0;       ///< failed covers: corners that were asked about anew
  std::int64_t separation = 0;  ///< failed certificates of separating tangents
  std::int64_t tangents_max = 0;
  std::int64_t clusters_max = 0;
  std::int64_t queue_max = 0;  ///< certificates pending, and posts to come
  std::int64_t work = 0;       ///< disjoint hulls, summed over the stops of the plane
};

struct KineticHorizon {
  std::vector<Edge> edges;  ///< by rising (a, b)
  EventCounts events;
};

/// The same set of edges as FindHorizon, by the algorithm of the thesis: a plane falls through the
/// terrain, and the visual lines of its slice are kept by a queue of certificates. It shares with
/// FindHorizon the terrain and exact numbers, but no algorithm: each is a check of the other.
///
/// Hulls are certified by the turns at their corners and by a triangle around each interior point,
/// not by the tree of [BaschGuibasHershberger97]: 513 x 513 posts of the Presidential Range have
/// 6,652 failures of the former and 69,456 of the latter, among 263,168 posts and 34,676 failures
/// of bitangents.
///
/// Exact for every terrain within the limits, equal heights and posts in line included.
/// work_budget: most EventCounts::work to be done; unset: DefaultKineticWorkBudget.
/// Errors: kCancelled; kUnsupportedData, kind kinetic-too-large, where 2 log2(columns or rows) + 3
/// log2(range of heights in quanta) is beyond 118: remedy, the adaptive engine; kResourceExhausted,
/// kind work-budget, where the budget is spent, or more than kMostKineticHulls are disjoint: the
/// same remedy.
Result<KineticHorizon> FindHorizonKinetic(const Terrain& terrain, const RunControl& control,
                                          std::optional<std::int64_t> work_budget = std::nullopt);

/// The same under the default budget, with all invariants of the scene (kinetic/scene.h) checked
/// after every step: for tests. Throws InternalError where one does not hold. Cost: some ten times
/// as much, and more where many hulls are apart.
Result<KineticHorizon> FindHorizonKineticChecked(const Terrain& terrain);

/// 200 an edge of the terrain, and no less than 5 * 10^7 in all: some forty times what the hardest
/// real DEM known needs.
std::int64_t DefaultKineticWorkBudget(std::int64_t terrain_edges);

/// The tangents of so many hulls, each with every other, take a quarter of a gigabyte and a minute.
inline constexpr std::int64_t kMostKineticHulls = 1000;

}  // namespace farhorizon
