// Certificates: a horizon edge that is in the network occludes itself. Any other is asked of a few
// ridges near it, as virtual occluders over an empty set: only those ridges then occlude it, and
// they become its certificate. A change first inserts and removes ridges, then proves all
// dependents of the removed ones, and undoes itself if one proof fails. Cost of a change: one
// visibility query with at most kMostNearby occluders for each dependent.
#include "core/simplify/ridge_network.h"

#include <algorithm>
#include <queue>
#include <tuple>

#include "core/base/result.h"

namespace farhorizon {

namespace {

// A certificate has at most so many ridges, the nearest. Any count is sound: a proof with fewer
// ridges fails more often, one with more takes longer and gives each ridge more dependents.
constexpr std::size_t kMostNearby = 16;

std::size_t Index(std::int32_t id) { return static_cast<std::size_t>(id); }

}  // namespace

RidgeNetwork::RidgeNetwork(const Terrain& terrain, const Horizon& horizon, FinerHeights scale)
    : terrain_(&terrain),
      horizon_(&horizon),
      scale_(scale),
      nothing_(terrain.dem().columns, terrain.dem().rows) {
  ridges_.reserve(horizon.edges.size() * 2);
  certificates_.resize(horizon.edges.size());
  for (std::size_t e = 0; e < horizon.edges.size(); ++e) {
    const RidgeId ridge = Add(horizon.edges[e].edge);
    Insert(ridge);
    // Ridge and horizon edge have the same number; the edge occludes itself.
    certificates_[e] = {ridge};
    ridges_[Index(ridge)].dependents = {static_cast<std::int32_t>(e)};
  }
}

Segment RidgeNetwork::Scaled(Edge edge) const {
  return {scale_.Scale(terrain_->Point(edge.a)), scale_.Scale(terrain_->Point(edge.b))};
}

RidgeNetwork::RidgeId RidgeNetwork::Add(Edge edge) {
  Ridge ridge;
  ridge.edge = edge;
  ridges_.push_back(std::move(ridge));
  return static_cast<RidgeId>(ridges_.size()) - 1;
}

void RidgeNetwork::Insert(RidgeId r) {
  Ridge& ridge = ridges_[Index(r)];
  ridge.in_network = true;
  ridges_of_[ridge.edge.a].push_back(r);
  ridges_of_[ridge.edge.b].push_back(r);
}

void RidgeNetwork::Remove(RidgeId r) {
  Ridge& ridge = ridges_[Index(r)];
  ridge.in_network = false;
  for (const VertexId v : {ridge.edge.a, ridge.edge.b}) {
    std::vector<RidgeId>& around = ridges_of_[v];
    std::erase(around, r);
    if (around.empty()) ridges_of_.erase(v);
  }
}

VertexId RidgeNetwork::OtherEnd(RidgeId r, VertexId v) const {
  const Edge& edge = ridges_[Index(r)].edge;
  return edge.a == v ? edge.b : edge.a;
}

bool RidgeNetwork::HasRidge(Edge edge) const {
  const auto around = ridges_of_.find(edge.a);
  if (around == ridges_of_.end()) return false;
  return std::any_of(around->second.begin(), around->second.end(),
                     [&](RidgeId r) { return ridges_[Index(r)].edge == edge; });
}

bool RidgeNetwork::MayMove(VertexId v, VertexId b) const {
  const auto around = ridges_of_.find(v);
  if (around == ridges_of_.end()) return true;
  return allowance_ > 0 && std::any_of(around->second.begin(), around->second.end(),
                                       [&](RidgeId r) { return OtherEnd(r, v) == b; });
}

bool RidgeNetwork::Move(VertexId v, VertexId b) {
  const auto around = ridges_of_.find(v);
  if (around == ridges_of_.end()) return true;
  const std::vector<RidgeId> old = around->second;
  std::vector<Edge> replacements;
  for (const RidgeId r : old) {
    const VertexId other = OtherEnd(r, v);
    if (other != b && !HasRidge(MakeEdge(other, b))) replacements.push_back(MakeEdge(other, b));
  }
  return Replace(old, replacements);
}

std::vector<std::int32_t> RidgeNetwork::DependentsOf(std::span<const RidgeId> ridges) const {
  std::vector<std::int32_t> dependents;
  for (const RidgeId r : ridges) {
    for (const std::int32_t e : ridges_[Index(r)].dependents) {
      const std::vector<RidgeId>& certificate = certificates_[Index(e)];
      if (std::binary_search(certificate.begin(), certificate.end(), r)) dependents.push_back(e);
    }
  }
  std::sort(dependents.begin(), dependents.end());
  dependents.erase(std::unique(dependents.begin(), dependents.end()), dependents.end());
  return dependents;
}

bool RidgeNetwork::ProveNearby(std::int32_t e, const Segment& lowered,
                               std::span<const RidgeId> replacements) {
  std::vector<RidgeId> nearby(replacements.begin(), replacements.end());
  const auto add_around = [&](VertexId v) {
    const auto around = ridges_of_.find(v);
    if (around == ridges_of_.end()) return;
    nearby.insert(nearby.end(), around->second.begin(), around->second.end());
  };
  for (const RidgeId r : replacements) {
    add_around(ridges_[Index(r)].edge.a);
    add_around(ridges_[Index(r)].edge.b);
  }
  for (const RidgeId r : certificates_[Index(e)]) {
    if (ridges_[Index(r)].in_network) nearby.push_back(r);
  }
  std::sort(nearby.begin(), nearby.end());
  nearby.erase(std::unique(nearby.begin(), nearby.end()), nearby.end());
  const auto distance = [&](RidgeId r) {
    const Point3i a = terrain_->Point(ridges_[Index(r)].edge.a);
    const Point3i b = terrain_->Point(ridges_[Index(r)].edge.b);
    const std::int64_t dx = std::int64_t{a.x} + b.x - lowered.a.x - lowered.b.x;
    const std::int64_t dy = std::int64_t{a.y} + b.y - lowered.a.y - lowered.b.y;
    return dx * dx + dy * dy;
  };
  std::sort(nearby.begin(), nearby.end(), [&](RidgeId p, RidgeId q) {
    return std::pair(distance(p), p) < std::pair(distance(q), q);
  });
  if (nearby.size() > kMostNearby) nearby.resize(kMostNearby);
  virtual_occluders_.clear();
  for (const RidgeId r : nearby) {
    Segment virtual_occluder = Scaled(ridges_[Index(r)].edge);
    if (virtual_occluder.a.z > virtual_occluder.b.z)
      std::swap(virtual_occluder.a, virtual_occluder.b);
    virtual_occluders_.push_back(virtual_occluder);
  }
  const VisibilityQuery query{
      .segment = lowered, .ties = Ties::kBlock, .hints = {.virtual_occluders = virtual_occluders_}};
  if (nothing_.FindLineOfSight(query).witness) {
    return false;
  }
  std::sort(nearby.begin(), nearby.end());
  certificates_[Index(e)] = std::move(nearby);
  return true;
}

bool RidgeNetwork::Prove(std::int32_t e, std::span<const RidgeId> replacements) {
  std::vector<RidgeId>& certificate = certificates_[Index(e)];
  if (ridges_[Index(e)].in_network) {
    certificate = {e};
    return true;
  }
  const Segment lowered = Lowered(Scaled(horizon_->edges[Index(e)].edge), allowance_);
  return ProveNearby(e, lowered, replacements);
}

bool RidgeNetwork::Replace(std::span<const RidgeId> old, const std::vector<Edge>& replacements) {
  const std::vector<std::int32_t> dependents = DependentsOf(old);
  std::vector<std::vector<RidgeId>> before;
  before.reserve(dependents.size());
  const std::size_t first_inserted = ridges_.size();
  std::vector<RidgeId> inserted;
  for (const Edge& edge : replacements) {
    inserted.push_back(Add(edge));
    Insert(inserted.back());
  }
  for (const RidgeId r : old) Remove(r);
  for (const std::int32_t e : dependents) {
    before.push_back(certificates_[Index(e)]);
    if (Prove(e, inserted)) continue;
    // Undo.
    for (std::size_t i = 0; i < before.size(); ++i) {
      certificates_[Index(dependents[i])] = std::move(before[i]);
    }
    for (const RidgeId r : inserted) Remove(r);
    ridges_.resize(first_inserted);
    for (const RidgeId r : old) Insert(r);
    return false;
  }
  for (const std::int32_t e : dependents) {
    for (const RidgeId r : certificates_[Index(e)]) ridges_[Index(r)].dependents.push_back(e);
  }
  for (const RidgeId r : old) ridges_[Index(r)].dependents = {};
  return true;
}

void RidgeNetwork::PruneLeaves(const RunControl& control) {
  if (allowance_ == 0) return;
  // In ascending order of the ridge's upper end: low ridges are the likeliest to be occluded.
  using Leaf = std::tuple<std::int32_t, RidgeId>;
  std::priority_queue<Leaf, std::vector<Leaf>, std::greater<>> leaves;
  const auto consider = [&](RidgeId r) {
    const Edge& edge = ridges_[Index(r)].edge;
    if (ridges_of_[edge.a].size() > 1 && ridges_of_[edge.b].size() > 1) return;
    leaves.emplace(std::max(terrain_->Point(edge.a).z, terrain_->Point(edge.b).z), r);
  };
  for (RidgeId r = 0; r < static_cast<RidgeId>(ridges_.size()); ++r) {
    if (ridges_[Index(r)].in_network) consider(r);
  }
  while (!leaves.empty() && !control.StopRequested()) {
    const RidgeId r = std::get<1>(leaves.top());
    leaves.pop();
    if (!ridges_[Index(r)].in_network) continue;
    const Edge edge = ridges_[Index(r)].edge;
    if (!Replace(std::span(&r, 1), {})) continue;
    for (const VertexId v : {edge.a, edge.b}) {
      const auto around = ridges_of_.find(v);
      if (around == ridges_of_.end() || around->second.size() != 1) continue;
      consider(around->second.front());
    }
  }
}

}  // namespace farhorizon
