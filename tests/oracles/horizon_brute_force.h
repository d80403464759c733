#pragma once

#include <optional>
#include <vector>

#include "core/horizon/visibility/occluder_set.h"
#include "core/terrain/terrain.h"
#include "tests/oracles/point_view_by_definition.h"

namespace farhorizon {

/// Any triangulated surface; indices: n_triangles x 3 into `points`. No two triangles overlap in
/// plan.
struct OracleMesh {
  std::vector<Point3i> points;
  std::vector<Triangle> triangles;
};

/// The triangles of a terrain, its posts keeping their ids.
OracleMesh MeshOf(const Terrain& terrain);

/// Every edge whose faces are not coplanar, or that has one face only, by rising (a, b).
std::vector<Edge> CreasesOf(const OracleMesh& mesh);

/// Every edge, by rising (a, b).
std::vector<Edge> EdgesOf(const OracleMesh& mesh);

/// The horizon edges of `mesh` by definition D2: creases e for which {l : g_e(l) = H(l)} has
/// interior points among the plan lines. By rising (a, b). Exact; slow.
std::vector<Edge> HorizonByBruteForce(const OracleMesh& mesh);
std::vector<Edge> HorizonByBruteForce(const Terrain& terrain);

/// Lines of sight: through the point t of the way along the segment, in the directions of `gap` but
/// for finitely many of them.
struct OracleLineOfSight {
  oracle::DyadicNumber t;
  oracle::FreeGap gap;
};

/// A sample of the lines of sight that touch `segment` and meet none of `obstacles` above it
/// (kPass), or at or above it (kBlock); nullopt where they have no interior points among the plan
/// lines. Exact.
///
/// Requires: neither the segment nor an obstacle is a point in plan; the extent of all in plan
/// times that in height is below 2^60.
std::optional<OracleLineOfSight> LineOfSightByBruteForce(const Segment& segment,
                                                         const std::vector<Segment>& obstacles,
                                                         Ties ties);

/// The same answer without any short cut: one sample in every cell of every critical position there
/// is. The slow twin of the slow twin; some 30 obstacles are its limit.
bool LineOfSightByAllCells(const Segment& segment, const std::vector<Segment>& obstacles,
                           Ties ties);

}  // namespace farhorizon
