// The sum is a square in one vertex's height, as long as no other edge becomes a line's top: its
// least is one division away. The change is then priced as any other, so that where another edge
// does become the top, or a rise is forbidden, half of the way is tried, or none.
#include <algorithm>
#include <cmath>

#include "core/simplify/polish/least_gain.h"
#include "core/simplify/polish/polish.h"
#include "core/simplify/polish/vertex_change.h"

namespace farhorizon {

namespace {

constexpr float kLeastStep = 1e-3F;  // metres: what is less is left out

void Fit(Workpiece& work, VertexChange& change) {
  const Place from = change.place();
  const HeightPull posts = change.PullOfPosts(from);
  const HeightPull lines = change.PullOfLines();
  const float stiffness = posts.stiffness + lines.stiffness;
  if (!(stiffness > 0)) return;
  const float rise = (posts.pull + lines.pull) / stiffness;
  if (!(std::abs(rise) > kLeastStep)) return;
  const float least = -kLeastGain * (1 + change.before());
  for (const float part : {1.0F, 0.5F}) {
    const Place to = work.ground.WithHeight(from.x, from.y, from.plan + part * rise);
    if (change.Cost(to, least) >= least || !change.IsAllowed(to)) continue;
    change.Make(to);
    return;
  }
}

}  // namespace

Status FitHeights(Workpiece& work, const RunControl& control) {
  VertexChange change(work);
  for (std::int32_t v = 0; v < work.mesh.vertices(); ++v) {
    if (v % kVerticesBetweenChecks == 0 && control.StopRequested()) {
      return Error{ErrorCode::kCancelled, "stopped while simplifying"};
    }
    if (!work.IsFree(v) || work.ground.OnSide(work.mesh.at(v)) || !change.Begin(v)) continue;
    Fit(work, change);
  }
  return Ok{};
}

}  // namespace farhorizon
