// Half-edge collapses: a vertex goes onto one of its neighbours, so edges that do not end at it
// stay. Costs only grow while they are summed, but for what lines may give back, so a candidate is
// dropped once it exceeds the best by that.
#include "core/simplify/order/collapser.h"

#include <algorithm>

namespace farhorizon {

namespace {

// Wider rings are rare, and their vertices will go when their neighbours have gone.
constexpr std::int32_t kMostNeighbours = 40;

}  // namespace

bool Collapser::Fits(std::int32_t j) const {
  const Place& b = ring_.at(j);
  for (std::int32_t i = 0; i < ring_.sides(); ++i) {
    const std::int32_t k = ring_.after(i);
    if (i != j && k != j && !IsSound(b, ring_.at(i), ring_.at(k))) return false;
  }
  return true;
}

// The change of the sum by a collapse onto the neighbour at place j; as soon as it is known to be
// at least `most`, any such number.
float Collapser::Cost(std::int32_t j, float before, float most, bool rises) const {
  const PostSquares& measure = work_->mesh.measure();
  const Place& b = ring_.at(j);
  float cost = -before;
  if (!ring_.closed) cost += measure.OfRim(ring_.at(ring_.count - 1), ring_.at(0));
  for (std::int32_t i = 0; i < ring_.sides() && cost < most; ++i) {
    const std::int32_t k = ring_.after(i);
    if (i != j && k != j) cost += measure.Of(b, ring_.at(i), ring_.at(k));
  }
  if (cost >= most) return cost;
  cost += work_->price.ChangeOfLost(ring_, b, j);
  for (std::int32_t i = 0; i < ring_.count && rises && cost < most; ++i) {
    if (!ring_.Joined(i, j)) cost += work_->price.RiseOf(b, ring_.at(i));
  }
  return cost;
}

std::pair<float, std::int32_t> Collapser::Rate(std::int32_t v, const Refused& refused) {
  std::pair<float, std::int32_t> best{SkylinePrice::kForbidden, kNone};
  HalfEdgeMesh& mesh = work_->mesh;
  if (!mesh.Gather(v, ring_) || ring_.count > kMostNeighbours || ring_.count < 3) return best;
  const Place& centre = mesh.at(v);
  const Place& first = ring_.at(0);
  const Place& last = ring_.at(ring_.count - 1);
  // The outline keeps its shape: a vertex of the rim goes only along a straight piece of it.
  if (!ring_.closed && Turn(first, centre, last) != 0) return best;
  const float slack = work_->price.Begin(v);
  work_->price.FindLost(ring_);
  const bool rises = work_->price.MayRiseAround(ring_, centre);
  float before = 0;
  if (!ring_.closed) {
    before = mesh.measure().OfRim(centre, first) + mesh.measure().OfRim(last, centre);
  }
  for (std::int32_t i = 0; i < ring_.sides(); ++i) before += mesh.squares(ring_.triangle_at(i));
  const std::int32_t step = ring_.closed ? 1 : ring_.count - 1;
  for (std::int32_t j = 0; j < ring_.count; j += step) {
    if (refused[static_cast<std::size_t>(j)]) continue;
    if (ring_.count + mesh.degree(ring_.id(j)) > kMostNeighbours + 4 || !Fits(j)) continue;
    const float cost = Cost(j, before, best.first + slack, rises);
    if (cost < best.first) best = {cost, ring_.id(j)};
  }
  return best;
}

bool Collapser::IsAllowed(std::int32_t j) const {
  // At a rim the outline's new piece, from the first neighbour to the last, is among the spokes.
  const Place& centre = work_->mesh.at(ring_.centre);
  for (std::int32_t i = 0; i < ring_.count; ++i) {
    if (!ring_.Joined(i, j) && !work_->rules.AllowsChord(ring_, centre, j, i)) return false;
  }
  return true;
}

std::int32_t Collapser::PlaceInRing(std::int32_t v) const {
  const auto end = ring_.neighbour.begin() + ring_.count;
  return static_cast<std::int32_t>(std::find(ring_.neighbour.begin(), end, v) -
                                   ring_.neighbour.begin());
}

std::pair<float, std::int32_t> Collapser::RateAllowed(std::int32_t v) {
  Refused refused;
  for (;;) {
    const auto [cost, b] = Rate(v, refused);
    if (b == kNone || cost >= SkylinePrice::kForbidden) return {cost, kNone};
    const std::int32_t j = PlaceInRing(b);
    if (IsAllowed(j)) return {cost, b};
    refused[static_cast<std::size_t>(j)] = true;
  }
}

// Rates v, where that is due; true, with the ring gathered, where it belongs no later than `bucket`
// and so may go at once. Rules are asked only then: most vertices are rated several times.
bool Collapser::Consider(std::int32_t v, std::int32_t bucket) {
  const auto at = static_cast<std::size_t>(v);
  if (!work_->mesh.IsVertex(v) || work_->stays[at]) return false;
  const auto bucket_of = [&](float cost) {
    // What has to go from a side goes first, so that sides depend on nothing but their heights.
    return work_->ground.OnSide(work_->mesh.at(v)) ? 0 : BucketQueue::BucketOf(cost);
  };
  if (bucket >= 0 && !work_->stale[at] && target_[v] != kNone) {
    if (!work_->mesh.Gather(v, ring_)) return false;
    if (IsAllowed(PlaceInRing(target_[v]))) return true;
  } else {
    const auto [cost, b] = Rate(v, {});
    work_->stale[at] = false;
    target_[v] = b;
    if (b == kNone || cost >= SkylinePrice::kForbidden) {
      target_[v] = kNone;
      return false;
    }
    const std::int32_t its = bucket_of(cost);
    if (its > bucket) {
      work_->Enqueue(v, its);
      return false;
    }
    if (IsAllowed(PlaceInRing(b))) return true;
  }
  const auto [cost, b] = RateAllowed(v);
  work_->stale[at] = false;
  target_[v] = b;
  if (b == kNone) return false;  // until its ring changes
  const std::int32_t its = bucket_of(cost);
  if (its > bucket) work_->Enqueue(v, its);
  return its <= bucket;
}

void Collapser::Collapse(std::int32_t v) {
  const std::int32_t b = target_[v];
  const std::int32_t j = PlaceInRing(b);
  HalfEdgeMesh& mesh = work_->mesh;
  if (log_.IsOn()) log_.Record(ring_, j);
  mesh.Collapse(ring_, b);
  for (std::int32_t i = 0; i < ring_.sides(); ++i) mesh.Measure(ring_.triangle_at(i));
  work_->price.RestoreAfterCollapse(
      ring_, b, j, [&](std::int32_t u) { work_->stale[static_cast<std::size_t>(u)] = true; });
  if (!work_->price.MayRiseAround(ring_, mesh.at(b))) return;
  for (std::int32_t i = 0; i < ring_.count; ++i) {
    if (!ring_.Joined(i, j) && work_->price.MayRise(ring_.at(j), ring_.at(i))) {
      work_->skyline.Raise(b, ring_.id(i));
    }
  }
}

bool Collapser::Force(std::int32_t v) {
  const auto [cost, b] = RateAllowed(v);
  if (b == kNone) return false;
  target_[v] = b;
  Collapse(v);
  for (std::int32_t k = 0; k < ring_.count; ++k) work_->Touch(ring_.id(k), 0);
  return true;
}

}  // namespace farhorizon
