// The chain of levels. Each level collapses the one before it further. Every collapse keeps to
// three conditions: the vertical error at every post (Star), no edge above the DEM's skyline
// (SkylineGuard), no part of that skyline lost (RidgeNetwork). Proofs: core/simplify/README.md,
// sections 2 and 3.
#include "core/simplify/lod_chain.h"

#include <algorithm>

#include "core/geometry/plan.h"
#include "core/horizon/guard/skyline_guard.h"
#include "core/simplify/collapse.h"
#include "core/simplify/ridge_network.h"
#include "core/terrain/border.h"

namespace farhorizon {

namespace {

// No triangle of a level may be steeper than the DEM's steepest. So the error in height that comes
// from rounding a vertex's coordinates is no greater than it would be on the DEM, and no sliver is
// upright.
Slope SteepestSlope(const Terrain& terrain) {
  Slope steepest;
  for (const Triangle& t : terrain.Triangles()) {
    const Slope slope = SlopeOf(terrain.Point(t[0]), terrain.Point(t[1]), terrain.Point(t[2]));
    steepest.by_column = std::max(steepest.by_column, slope.by_column);
    steepest.by_row = std::max(steepest.by_row, slope.by_row);
  }
  return steepest;
}

class ChainBuilder {
 public:
  ChainBuilder(const Terrain& terrain, const Horizon& horizon)
      : terrain_(terrain),
        horizon_(horizon),
        outline_(OutlinePosts(terrain)),
        steepest_(SteepestSlope(terrain)),
        collapser_(terrain),
        guard_(terrain, horizon),
        ridges_(terrain, horizon, guard_.scale()) {}

  Status BuildLevel(const LevelBudget& budget, const RunControl& control,
                    const std::function<void(double)>& report) {
    const double quantum = terrain_.dem().quantum_m;
    const std::int32_t steps = guard_.scale().Steps(budget.silhouette_error_m / quantum);
    ridges_.Allow(steps);
    ridges_.PruneLeaves(control);
    CollapseRules rules;
    rules.limits = {budget.vertical_error_m / quantum, budget.longest_edge, budget.least_altitude,
                    steepest_};
    rules.removable = RemovablePosts(steps);
    rules.may_add_edge = [this, steps](VertexId p, VertexId q) {
      return guard_.IsOccluded(p, q, steps);
    };
    rules.may_move = [this](VertexId v, VertexId b) { return ridges_.MayMove(v, b); };
    rules.move_ridges = [this](VertexId v, VertexId b) { return ridges_.Move(v, b); };
    return collapser_.Run(rules, control, report);
  }

  [[nodiscard]] Lod Level() const {
    const Surface& surface = collapser_.surface();
    Lod lod{{{}, {}, surface.Triangles()}, {}};
    for (VertexId v = 0; v < terrain_.post_count(); ++v) {
      if (!surface.IsVertex(v)) continue;
      lod.mesh.posts.push_back(v);
      lod.mesh.heights_m.push_back(terrain_.dem().HeightM(v));
    }
    for (std::size_t e = 0; e < horizon_.edges.size(); ++e) {
      // While both posts of an edge are vertices it is an edge: see Surface.
      const Edge& edge = horizon_.edges[e].edge;
      if (surface.IsVertex(edge.a) && surface.IsVertex(edge.b)) {
        lod.kept.push_back(static_cast<std::int32_t>(e));
      }
    }
    return lod;
  }

 private:
  // The sides of the tile keep all their posts at every level. A rule that removed some of them
  // would have to depend on the side's heights alone, so that the neighbouring tile removes the
  // same; but whether a removal is within the budgets depends on the ground behind the side, in
  // either tile. Measured: one removal in ten is not allowed in one of the two tiles. Other borders
  // keep their posts where the allowance is 0, and so each of their horizon edges.
  [[nodiscard]] std::vector<bool> RemovablePosts(std::int32_t steps) const {
    std::vector<bool> removable(outline_.size());
    for (VertexId v = 0; v < terrain_.post_count(); ++v) {
      const auto at = static_cast<std::size_t>(v);
      removable[at] = !OnSide(terrain_.dem(), v) && (steps > 0 || !outline_[at]);
    }
    return removable;
  }

  const Terrain& terrain_;
  const Horizon& horizon_;
  std::vector<bool> outline_;
  Slope steepest_;
  Collapser collapser_;
  SkylineGuard guard_;
  RidgeNetwork ridges_;
};

}  // namespace

Result<std::vector<Lod>> BuildLodChain(const Terrain& terrain, const Horizon& horizon,
                                       const std::vector<LevelBudget>& budgets,
                                       const RunControl& control) {
  control.Report(Stage::kSimplify, 0);
  ChainBuilder builder(terrain, horizon);
  std::vector<Lod> levels;
  const auto count = static_cast<double>(budgets.size());
  for (const LevelBudget& budget : budgets) {
    const auto done = static_cast<double>(levels.size());
    const auto report = [&](double share) {
      control.Report(Stage::kSimplify, (done + share) / count);
    };
    Status status = builder.BuildLevel(budget, control, report);
    if (!status) return std::move(status.error());
    levels.push_back(builder.Level());
  }
  control.Report(Stage::kSimplify, 1.0);
  return levels;
}

}  // namespace farhorizon
