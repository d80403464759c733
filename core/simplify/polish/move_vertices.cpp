#include <algorithm>

#include "core/simplify/polish/least_gain.h"
#include "core/simplify/polish/polish.h"
#include "core/simplify/polish/vertex_change.h"

namespace farhorizon {

namespace {

// Of the mean squares around a vertex a vertex must have to be moved: the others gain little.
constexpr double kWorth = 0.5;
constexpr double kTrianglesAround = 6;
// Of a sum, what it may be off, so that no place is left out for rounding's sake.
constexpr float kRounding = 1e-5F;

float MeanAround(const HalfEdgeMesh& mesh) {
  double sum = 0;
  for (std::int32_t t = 0; t < mesh.half_edges() / 3; ++t) {
    if (mesh.Stands(t)) sum += static_cast<double>(mesh.squares(t));
  }
  return static_cast<float>(kTrianglesAround * sum / mesh.triangles());
}

// The best place around the vertex, or where it is.
Place BestAround(const Workpiece& work, const VertexChange& change) {
  const Ground& ground = work.ground;
  Place best = change.place();
  float least = -kLeastGain * (1 + change.before());
  for (std::int32_t step = 2; step >= 1; --step) {
    const Place from = best;
    for (std::int32_t k = 0; k < 9; ++k) {
      const std::int32_t x = from.x + (k % 3 - 1) * step;
      const std::int32_t y = from.y + (k / 3 - 1) * step;
      if (k == 4 || x < 0 || y < 0 || x >= ground.columns() || y >= ground.rows()) continue;
      if (!ground.HasData(x, y)) continue;
      Place place = ground.At(x, y);
      if (!change.IsInside(place)) continue;
      if (change.CarriesNone()) {
        const HeightPull pull = change.PullOfPosts(place);
        if (pull.stiffness > 0) {
          const float rise = pull.pull / pull.stiffness;
          // At the best height the posts' part is known: lines can give back no more than `slack`.
          const float posts = (1 - kRounding) * pull.sum - rise * pull.pull - change.before();
          if (posts - change.slack() >= least) continue;
          place = ground.WithHeight(x, y, place.plan + rise);
        }
      }
      const float cost = change.Cost(place, least);
      if (cost >= least) continue;
      least = cost;
      best = place;
    }
  }
  return best;
}

}  // namespace

Status MoveVertices(Workpiece& work, const RunControl& control) {
  const auto worth = static_cast<float>(kWorth) * MeanAround(work.mesh);
  VertexChange change(work);
  for (std::int32_t v = 0; v < work.mesh.vertices(); ++v) {
    if (v % kVerticesBetweenChecks == 0 && control.StopRequested()) {
      return Error{ErrorCode::kCancelled, "stopped while simplifying"};
    }
    if (!work.IsFree(v) || work.mesh.OnRim(v) || !change.Begin(v)) continue;
    if (change.before() + change.slack() < worth) continue;
    const Place best = BestAround(work, change);
    const bool moved = best.x != change.place().x || best.y != change.place().y;
    if (moved && change.IsAllowed(best)) change.Make(best);
  }
  return Ok{};
}

}  // namespace farhorizon
