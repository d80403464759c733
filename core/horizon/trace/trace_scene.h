#pragma once

#include <cstdint>

#include "core/horizon/kinetic/bitangents/bitangent_scene.h"
#include "core/horizon/trace/sweep_trace.h"

namespace farhorizon {

/// Adds the hulls, the bitangents and the points on horizon edges to `trace`, as they are at depth
/// s.
/// Requires: the scene's invariants hold just after s, or after the last event before it.
void TraceScene(const kinetic::BitangentScene& scene, std::int64_t s, SweepTrace& trace);

}  // namespace farhorizon
