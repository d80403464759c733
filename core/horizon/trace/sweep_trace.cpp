// The sweep stopped at one height: what each engine keeps there, put side by side.
#include "core/horizon/trace/sweep_trace.h"

#include <algorithm>
#include <cstdint>
#include <utility>

#include "core/horizon/kinetic/kinetic_horizon.h"
#include "core/horizon/kinetic/kinetic_sweep.h"
#include "core/horizon/sweep/candidates.h"
#include "core/horizon/sweep/hull_sweep.h"
#include "core/horizon/trace/trace_scene.h"

namespace farhorizon {

Result<SweepTrace> TraceSweep(const Terrain& terrain, std::int32_t level, const Watch& watch) {
  const std::int64_t budget = DefaultKineticWorkBudget(terrain.CountEdges());
  kinetic::KineticSweep sweep(terrain, watch, budget, false);
  if (level > sweep.summit() || level < sweep.lowest()) {
    return Error{ErrorCode::kInvalidArgument, "the terrain has no slice at this level",
                 "no-such-level"};
  }
  const std::int64_t s = std::int64_t{sweep.summit()} - level;
  Status run = sweep.Run(s);
  if (!run) return std::move(run.error());
  Result<HullSweep> hulls = SweepHulls(terrain, 1, watch);
  if (!hulls) return std::move(hulls.error());
  Result<Candidates> culled = FindCandidates(terrain, *hulls, 1, watch);
  if (!culled) return std::move(culled.error());
  SweepTrace trace;
  trace.level = level;
  trace.columns = terrain.dem().columns;
  trace.rows = terrain.dem().rows;
  trace.contours = ContoursAt(terrain, level);
  for (const Candidate& candidate : culled->edges) {
    const Point3i a = terrain.Point(candidate.edge.a);
    const Point3i b = terrain.Point(candidate.edge.b);
    if (std::max(a.z, b.z) < level || std::min(a.z, b.z) > level) continue;
    trace.candidates.push_back({PlanPoint{static_cast<double>(a.x), static_cast<double>(a.y)},
                                PlanPoint{static_cast<double>(b.x), static_cast<double>(b.y)}});
  }
  TraceScene(sweep.scene(), s, trace);
  return trace;
}

}  // namespace farhorizon
