#include "core/simplify/polish/vertex_change.h"

namespace farhorizon {

bool VertexChange::Begin(std::int32_t v) {
  if (!work_.mesh.Gather(v, ring_)) return false;
  before_ = 0;
  for (std::int32_t i = 0; i < ring_.sides(); ++i) {
    before_ += work_.mesh.squares(ring_.triangle_at(i));
  }
  if (!ring_.closed) {
    before_ += RimSquares(work_.ground, place(), ring_.at(0)) +
               RimSquares(work_.ground, ring_.at(ring_.count - 1), place());
  }
  slack_ = work_.price.Begin(v);
  work_.price.FindLost(ring_);
  return true;
}

bool VertexChange::IsInside(const Place& place) const {
  for (std::int32_t i = 0; i < ring_.sides(); ++i) {
    if (Turn(place, ring_.at(i), ring_.at(ring_.after(i))) <= 0) return false;
  }
  return true;
}

HeightPull VertexChange::PullOfPosts(const Place& place) const {
  HeightPull sum;
  for (std::int32_t i = 0; i < ring_.sides(); ++i) {
    AddPull(work_.ground, place, ring_.at(i), ring_.at(ring_.after(i)), sum);
  }
  return sum;
}

HeightPull VertexChange::PullOfLines() const {
  HeightPull sum;
  work_.price.AddPullOfLines(ring_, place(), sum);
  return sum;
}

float VertexChange::Cost(const Place& place, float bound) const {
  const float most_m = work_.rules.most_m();
  float cost = -before_;
  for (std::int32_t i = 0; i < ring_.sides() && cost - slack_ < bound; ++i) {
    cost += Squares(work_.ground, place, ring_.at(i), ring_.at(ring_.after(i)), most_m);
  }
  if (!ring_.closed) {
    cost += RimSquares(work_.ground, place, ring_.at(0), most_m) +
            RimSquares(work_.ground, ring_.at(ring_.count - 1), place, most_m);
  }
  if (cost - slack_ >= bound) return cost;
  cost += work_.price.ChangeOfLost(ring_, place, -1);
  for (std::int32_t i = 0; i < ring_.count && cost < bound; ++i) {
    cost += work_.price.RiseOf(place, ring_.at(i));
  }
  return cost;
}

bool VertexChange::IsAllowed(const Place& place) const {
  for (std::int32_t i = 0; i < ring_.count; ++i) {
    if (!work_.rules.AllowsMove(this->place(), place, ring_.at(i))) return false;
  }
  return true;
}

}  // namespace farhorizon
