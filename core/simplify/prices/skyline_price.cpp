// Prices of changes on the sampled lines. Distances of a ring's places from a line are computed
// once for each line that the vertex carries; every candidate then asks only which sides and spokes
// cross it, and how high.
#include "core/simplify/prices/skyline_price.h"

#include <algorithm>

namespace farhorizon {

namespace {

// The greatest height of the ring's outline over a line at these distances.
float OutlineOver(const Ring& ring, const float* distance) {
  float height = SampledSkyline::kNone;
  for (std::int32_t i = 0; i < ring.sides(); ++i) {
    const std::int32_t k = ring.after(i);
    if (!Crosses(distance[i], distance[k])) continue;
    height = std::max(height, HeightBetween(ring.at(i), ring.at(k), distance[i], distance[k]));
  }
  return height;
}

// The same of spokes from `hub`, at distance h, to all places of the ring but those joined to j.
float SpokesOver(const Ring& ring, const float* distance, const Place& hub, float h,
                 std::int32_t j) {
  float height = SampledSkyline::kNone;
  for (std::int32_t i = 0; i < ring.count; ++i) {
    if (!Crosses(h, distance[i]) || (j >= 0 && ring.Joined(i, j))) continue;
    height = std::max(height, HeightBetween(hub, ring.at(i), h, distance[i]));
  }
  return height;
}

// Square metres; beyond rounding, where rises are not allowed.
constexpr float kLeastRise = 1e-4F;

}  // namespace

SkylinePrice::SkylinePrice(const HalfEdgeMesh& mesh, SampledSkyline& skyline)
    : mesh_(&mesh),
      skyline_(&skyline),
      hull_(mesh.ground(), skyline.pencils(), skyline.dem()),
      mark_(skyline.pencils().lines(), 0) {}

float SkylinePrice::Begin(std::int32_t v) {
  ++now_;
  float sum = 0;
  skyline_->carried().EraseIf(v, [&](std::int32_t line) {
    if (!skyline_->Carries(line, v) || mark_[line] == now_ || !skyline_->Counts(line)) return true;
    mark_[line] = now_;
    sum += skyline_->Square(line, skyline_->top(line));
    return false;
  });
  return weight_ * sum;
}

void SkylinePrice::FindLost(const Ring& ring) {
  lost_.clear();
  distances_.clear();
  skyline_->carried().ForEach(ring.centre, [&](std::int32_t line) {
    const std::size_t at = distances_.size();
    distances_.resize(at + static_cast<std::size_t>(ring.count));
    float* distance = distances_.data() + at;
    skyline_->pencils().Distances(line, ring.place.data(), ring.count, distance);
    const float rest = std::max(skyline_->Without(line, ring.centre), OutlineOver(ring, distance));
    lost_.push_back({line, rest, skyline_->Square(line, skyline_->top(line))});
  });
}

float SkylinePrice::ChangeOfLost(const Ring& ring, const Place& hub, std::int32_t j) const {
  float change = 0;
  const float* distance = distances_.data();
  for (const Lost& lost : lost_) {
    const float h = j >= 0 ? distance[j] : skyline_->pencils().Distance(lost.line, hub);
    const float height = std::max(lost.rest, SpokesOver(ring, distance, hub, h, j));
    change += skyline_->Square(lost.line, height) - lost.square;
    distance += ring.count;
  }
  return weight_ * change;
}

void SkylinePrice::AddPullOfLines(const Ring& ring, const Place& centre, HeightPull& pull) const {
  for (const Lost& lost : lost_) {
    const SampledSkyline::Crossing& best = skyline_->Best(lost.line);
    const Place& other = mesh_->at(best.a == ring.centre ? best.b : best.a);
    const float s = skyline_->pencils().Distance(lost.line, centre);
    const float t = skyline_->pencils().Distance(lost.line, other);
    if (!Crosses(s, t)) continue;
    const float share = t / (t - s);  // of the height over the line that is the centre's
    const float off = skyline_->dem()[lost.line] - skyline_->top(lost.line);
    pull.pull += weight_ * share * off;
    pull.stiffness += weight_ * share * share;
    pull.sum += weight_ * off * off;
  }
}

float SkylinePrice::RiseOf(const Place& a, const Place& b) const {
  if (!hull_.MayRise(a, b)) return 0;
  float sum = 0;
  skyline_->pencils().ForEachLineAcross(a, b, [&](std::int32_t line, float height) {
    const float top = skyline_->top(line);
    if (height <= top || !skyline_->Meets(line) || mark_[line] == now_) return;
    sum += skyline_->Square(line, height) - skyline_->Square(line, top);
  });
  if (!allow_rises_ && sum > kLeastRise) return kForbidden;
  return weight_ * sum;
}

float SkylinePrice::BeginFlip(const Ring& quad) {
  ++now_;
  flipped_.clear();
  float sum = 0;
  skyline_->carried().ForEach(quad.id(0), [&](std::int32_t line) {
    if (!skyline_->Carries(line, quad.id(0)) || !skyline_->Carries(line, quad.id(2)) ||
        mark_[line] == now_ || !skyline_->Counts(line)) {
      return;
    }
    mark_[line] = now_;
    flipped_.push_back(line);
    sum += skyline_->Square(line, skyline_->top(line));
  });
  return weight_ * sum;
}

float SkylinePrice::ChangeOfFlip(const Ring& quad) const {
  float change = 0;
  for (const std::int32_t line : flipped_) {
    std::array<float, 4> distance;
    skyline_->pencils().Distances(line, quad.place.data(), 4, distance.data());
    const float height =
        std::max({skyline_->Without(line, quad.id(0)), OutlineOver(quad, distance.data()),
                  SpokesOver(quad, distance.data(), quad.at(1), distance[1], 1)});
    change += skyline_->Square(line, height) - skyline_->Square(line, skyline_->top(line));
  }
  return weight_ * change;
}

void SkylinePrice::KeepAround(std::int32_t line, const Ring& ring, std::int32_t hub,
                              std::int32_t j) {
  std::array<float, Ring::kMost> distance;
  skyline_->pencils().Distances(line, ring.place.data(), ring.count, distance.data());
  const Place& centre = mesh_->at(hub);
  const float h = skyline_->pencils().Distance(line, centre);
  for (std::int32_t i = 0; i < ring.count; ++i) {
    const std::int32_t k = ring.after(i);
    const float s = distance[static_cast<std::size_t>(i)];
    const float t = distance[static_cast<std::size_t>(k)];
    if ((ring.closed || k > 0) && Crosses(s, t)) {
      skyline_->Keep(line, {HeightBetween(ring.at(i), ring.at(k), s, t), ring.id(i), ring.id(k)});
    }
    if ((j < 0 || !ring.Joined(i, j)) && Crosses(h, s)) {
      skyline_->Keep(line, {HeightBetween(centre, ring.at(i), h, s), hub, ring.id(i)});
    }
  }
  skyline_->Crown(line);
}

void SkylinePrice::RestoreLost(const Ring& ring, std::int32_t hub, std::int32_t j) {
  for (const Lost& lost : lost_) {
    skyline_->Refresh(lost.line);
    KeepAround(lost.line, ring, hub, j);
  }
}

void SkylinePrice::RestoreFlipped(const Ring& quad) {
  for (const std::int32_t line : flipped_) KeepAround(line, quad, quad.id(1), 1);
}

}  // namespace farhorizon
