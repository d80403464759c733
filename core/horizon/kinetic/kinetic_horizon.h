#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "core/base/result.h"
#include "core/base/run_control.h"
#include "core/horizon/kinetic/hulls/hull_certificates.h"
#include "core/terrain/terrain.h"

namespace farhorizon {

/// How many events a kinetic sweep had, by kind [Archambault03, section 3.2].
struct EventCounts {
  std::int64_t peak = 0;     ///< posts that begin a hull of their own
  std::int64_t regular = 0;  ///< posts that do none of the others (a peak inside a hull is one)
  std::int64_t saddle = 0;   ///< posts at which separate hulls join
  std::int64_t minimum = 0;  ///< posts all of whose neighbours were met before
  std::int64_t merge = 0;    ///< hulls that became part of another: at saddles and by collision
  std::int64_t hull = 0;     ///< certificates of hulls that failed
  std::int64_t inside = 0;   ///< interior points that got another triangle of their hull
  /// Of HullCertificates::kTree, the failures of `hull` by ChainCertificate (chain_merge.h): x; yli
  /// and yri; yt; slt and srt; sl and sr.
  std::array<std::int64_t, 5> tree{};
  /// Of KineticTangents::kNeighbours: corners that were asked about anew, since their cover failed;
  /// and certificates of separating tangents that failed.
  std::int64_t cover = 0;
  std::int64_t separation = 0;
  std::int64_t tangents_max = 0;  ///< separating tangents at one depth
  /// Of KineticTangents::kAllPairs: failed certificates of bitangents, by the kinds of figure 3.1:
  /// two active scene bitangents, active and inactive, active and hull, inactive and hull.
  std::array<std::int64_t, 4> by_kind{};
  std::int64_t clusters_max = 0;
  std::int64_t queue_max = 0;  ///< certificates pending, and posts to come
  std::int64_t work = 0;       ///< hulls looked at, and stops of the plane

  /// Failed certificates of tangents, all kinds.
  [[nodiscard]] std::int64_t Bitangents() const {
    return cover + separation + by_kind[0] + by_kind[1] + by_kind[2] + by_kind[3];
  }
};

struct KineticHorizon {
  std::vector<Edge> edges;  ///< by rising (a, b)
  EventCounts events;
};

/// Which tangents are kept (core/horizon/README.md, section 11).
enum class KineticTangents : std::uint8_t {
  kNeighbours,  ///< what proves that neighbouring hulls are disjoint, and hidden corners hidden
  kAllPairs,    ///< the four bitangents of each two hulls, as the thesis has them: O(m^2)
};

struct KineticOptions {
  /// Most EventCounts::work to be done; unset: DefaultKineticWorkBudget.
  std::optional<std::int64_t> work_budget = std::nullopt;
  KineticTangents tangents = KineticTangents::kNeighbours;
  HullCertificates hull = HullCertificates::kTurns;
};

/// The same set of edges as FindHorizon, by the algorithm of the thesis: a plane falls through the
/// terrain, and what its slice hides is kept by a queue of certificates. It shares with FindHorizon
/// the terrain and exact numbers, but no algorithm: each is a check of the other.
///
/// Exact for every terrain within the limits, equal heights and posts in line included.
/// Errors: kCancelled; kUnsupportedData, kind kinetic-too-large, where 2 log2(columns or rows) + 3
/// log2(range of heights in quanta) is beyond 118, with HullCertificates::kTree 4 of the latter:
/// remedy, the adaptive engine; kResourceExhausted, kind work-budget, where the budget is spent:
/// the same remedy.
/// Cost: memory O(n + m) for m hulls apart (kNeighbours).
Result<KineticHorizon> FindHorizonKinetic(const Terrain& terrain, const RunControl& control,
                                          const KineticOptions& options = {});

/// The same, with all invariants of the scene checked after every step: for tests. Throws
/// InternalError where one does not hold. Cost: some ten times as much, and more where many hulls
/// are apart.
Result<KineticHorizon> FindHorizonKineticChecked(const Terrain& terrain,
                                                 const KineticOptions& options = {});

/// 500 an edge of the terrain, and no less than 5 * 10^8 in all: some thirty times what the hardest
/// real DEM known needs, and some seconds.
std::int64_t DefaultKineticWorkBudget(std::int64_t terrain_edges);

}  // namespace farhorizon
