#pragma once

#include <array>
#include <cstdint>

namespace farhorizon::kinetic {

/// How often certificates failed, by what they proved, and what a scene held. What a scene does not
/// have stays 0: a NeighbourScene has covers and separating tangents, a BitangentScene the four
/// kinds of figure 3.1 of [Archambault03].
struct SceneCounts {
  std::int64_t hull_failures = 0;        ///< certificates of the kinetic hulls
  std::int64_t interior_failures = 0;    ///< a point at the border of its triangle
  std::int64_t left_interior = 0;        ///< of those, points that were outside their hull then
  std::int64_t cover_failures = 0;       ///< corners at which a line may have become visual
  std::int64_t separation_failures = 0;  ///< separating tangents at the end of a hull's edge
  /// Figure 3.1: A two active bitangents, B active and inactive, C active and an edge of the hull,
  /// D inactive and an edge of the hull.
  std::array<std::int64_t, 4> tangent_failures{};
  std::int64_t merges = 0;
  std::int64_t clusters_max = 0;
  std::int64_t tangents_max = 0;  ///< separating tangents at one depth, at most
  std::int64_t looks = 0;         ///< hulls that were looked at for corners and other hulls
};

}  // namespace farhorizon::kinetic
