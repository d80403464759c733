// The sweep stopped at one height, with the states of both engines there.
#include "core/horizon/trace/sweep_trace.h"

#include <algorithm>
#include <cstdint>
#include <utility>

#include "core/horizon/kinetic/bitangents/bitangent_scene.h"
#include "core/horizon/kinetic/kinetic_sweep.h"
#include "core/horizon/sweep/candidates.h"
#include "core/horizon/sweep/hull_sweep.h"
#include "core/horizon/trace/trace_scene.h"

namespace farhorizon {

Result<SweepTrace> TraceSweep(const Terrain& terrain, std::int32_t height,
                              const RunControl& control) {
  kinetic::KineticSweep<kinetic::BitangentScene> sweep(terrain, control, {});
  if (height > sweep.summit() || height < sweep.lowest()) {
    return Error{ErrorCode::kInvalidArgument, "the terrain has no slice at this height",
                 "no-such-level"};
  }
  const std::int64_t s = std::int64_t{sweep.summit()} - height;
  Status run = sweep.Run(s);
  if (!run) return std::move(run.error());
  Result<HullSweep> hulls = SweepHulls(terrain, 1, control);
  if (!hulls) return std::move(hulls.error());
  WorkBudget any(WorkBudget::kMost);
  Result<Candidates> culled = FindCandidates(terrain, *hulls, 1, any, control);
  if (!culled) return std::move(culled.error());
  SweepTrace trace;
  trace.height = height;
  trace.columns = terrain.dem().columns;
  trace.rows = terrain.dem().rows;
  trace.contours = ContoursAt(terrain, height);
  for (const Candidate& candidate : culled->edges) {
    const Point3i a = terrain.Point(candidate.edge.a);
    const Point3i b = terrain.Point(candidate.edge.b);
    if (std::max(a.z, b.z) < height || std::min(a.z, b.z) > height) continue;
    trace.candidates.push_back({PlanPoint{static_cast<double>(a.x), static_cast<double>(a.y)},
                                PlanPoint{static_cast<double>(b.x), static_cast<double>(b.y)}});
  }
  TraceScene(sweep.scene(), s, trace);
  return trace;
}

}  // namespace farhorizon
