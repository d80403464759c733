#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <set>
#include <string>
#include <vector>

#include "core/horizon/horizon.h"
#include "core/simplify/lod_chain.h"
#include "core/terrain/border.h"
#include "core/terrain/terrain.h"
#include "tests/support/mesh_checks.h"

namespace farhorizon {

/// Where a post is in a mesh's list; -1: it is no vertex.
inline std::ptrdiff_t IndexOf(const PostMesh& mesh, VertexId post) {
  const auto at = std::lower_bound(mesh.posts.begin(), mesh.posts.end(), post);
  return at == mesh.posts.end() || *at != post ? -1 : at - mesh.posts.begin();
}
inline double HeightAt(const PostMesh& mesh, VertexId post) {
  return mesh.heights_m[static_cast<std::size_t>(IndexOf(mesh, post))];
}

/// What is wrong with a level, found from its lists alone; empty where nothing is.
/// finer: the horizon edges that the finer level keeps; nullptr: level 0.
inline std::string FaultOfLevel(const Terrain& terrain, const Horizon& horizon, const Lod& level,
                                const std::vector<std::int32_t>* finer) {
  const PostMesh& mesh = level.mesh;
  if (mesh.heights_m.size() != mesh.posts.size()) return "not every post has a height";
  if (std::adjacent_find(mesh.posts.begin(), mesh.posts.end(), std::greater_equal<>()) !=
      mesh.posts.end()) {
    return "posts do not rise";
  }
  for (const double height : mesh.heights_m) {
    if (!std::isfinite(height)) return "a height is not finite";
  }
  std::set<VertexId> used;
  std::set<Edge> sides;
  for (const Triangle& t : mesh.triangles) {
    for (std::size_t k = 0; k < 3; ++k) {
      used.insert(t[k]);
      sides.insert(MakeEdge(t[k], t[(k + 1) % 3]));
      if (!terrain.dem().HasData(t[k])) return "a vertex has no data";
    }
  }
  if (!std::equal(used.begin(), used.end(), mesh.posts.begin(), mesh.posts.end())) {
    return "posts are not those that triangles use";
  }
  std::string fault = FaultOfCover(terrain, mesh.triangles);
  if (!fault.empty()) return fault;
  for (const Edge& edge : OutlineOf(mesh.triangles)) {
    if (!RunsAlongOutline(terrain, edge)) return "the outline leaves the terrain's";
  }
  std::vector<std::int32_t> present;
  for (std::size_t e = 0; e < horizon.edges.size(); ++e) {
    const auto index = static_cast<std::int32_t>(e);
    if (sides.count(horizon.edges[e].edge) == 0) continue;
    if (!finer || std::binary_search(finer->begin(), finer->end(), index)) present.push_back(index);
  }
  if (present != level.kept) return "kept are not the horizon edges that it has";
  if (!level.exact) return "";
  if (present.size() != horizon.edges.size()) return "an exact level lacks horizon edges";
  for (const HorizonEdge& h : horizon.edges) {
    for (const VertexId v : {h.edge.a, h.edge.b}) {
      if (HeightAt(mesh, v) != terrain.dem().HeightM(v)) return "a horizon edge has other heights";
    }
  }
  return "";
}

/// The greatest that a level is off at a post of the domain, metres in the frame of a ground that
/// drops by column_bend and row_bend (LodPlan): each post looked for in every triangle.
inline double GreatestErrorOf(const Terrain& terrain, const PostMesh& mesh, const LodPlan& plan) {
  const Dem& dem = terrain.dem();
  const auto drop = [&](VertexId v) {
    const double dx = dem.Column(v) - 0.5 * (dem.columns - 1);
    const double dy = dem.Row(v) - 0.5 * (dem.rows - 1);
    return plan.column_bend * dx * dx + plan.row_bend * dy * dy;
  };
  const auto turn = [&](VertexId o, VertexId p, VertexId q) {
    return -std::int64_t{dem.Column(p) - dem.Column(o)} * (dem.Row(q) - dem.Row(o)) +
           std::int64_t{dem.Column(q) - dem.Column(o)} * (dem.Row(p) - dem.Row(o));
  };
  double greatest = 0;
  for (VertexId v = 0; v < terrain.post_count(); ++v) {
    if (!terrain.IsVertex(v)) continue;
    double least = std::numeric_limits<double>::infinity();
    for (const Triangle& t : mesh.triangles) {
      const std::array<std::int64_t, 3> of = {turn(t[1], t[2], v), turn(t[2], t[0], v),
                                              turn(t[0], t[1], v)};
      if (of[0] < 0 || of[1] < 0 || of[2] < 0) continue;
      double height = 0;
      for (std::size_t k = 0; k < 3; ++k) {
        height += static_cast<double>(of[k]) * (HeightAt(mesh, t[k]) - drop(t[k]));
      }
      height /= static_cast<double>(of[0] + of[1] + of[2]);
      least = std::min(least, std::abs(height - (dem.HeightM(v) - drop(v))));
    }
    greatest = std::max(greatest, least);
  }
  return greatest;
}

}  // namespace farhorizon
