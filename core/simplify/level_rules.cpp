#include "core/simplify/level_rules.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>

namespace farhorizon {

namespace {

// Which of the four directions to a later neighbour leads from (0, 0) to (dx, dy); -1: none.
int DirectionOf(std::int32_t dx, std::int32_t dy) {
  if (dy == 0) return dx == 1 ? 0 : -1;
  if (dy != 1 || std::abs(dx) > 1) return -1;
  return 2 + dx;
}

}  // namespace

LevelRules::LevelRules(const Ground& ground, const Horizon& horizon)
    : ground_(&ground),
      horizon_(&horizon),
      guard_(ground.terrain(), horizon),
      locked_(static_cast<std::size_t>(ground.terrain().post_count()), false),
      edges_(static_cast<std::size_t>(ground.terrain().post_count()), 0) {
  for (const HorizonEdge& h : horizon.edges) {
    locked_[static_cast<std::size_t>(h.edge.a)] = true;
    locked_[static_cast<std::size_t>(h.edge.b)] = true;
    int shift = 0;
    std::uint8_t* flags = FlagsOf(h.edge.a, h.edge.b, shift);
    *flags = static_cast<std::uint8_t>(*flags | 1U << static_cast<unsigned>(shift));
  }
}

std::uint8_t* LevelRules::FlagsOf(VertexId p, VertexId q, int& shift) {
  const Place a = ground_->At(p);
  const Place b = ground_->At(q);
  shift = 2 * DirectionOf(b.x - a.x, b.y - a.y);
  return &edges_[static_cast<std::size_t>(p)];
}

bool LevelRules::Has(const Place& p, const Place& q, int bit) const {
  const bool forward = q.y > p.y || (q.y == p.y && q.x > p.x);
  const Place& a = forward ? p : q;
  const Place& b = forward ? q : p;
  const int direction = DirectionOf(b.x - a.x, b.y - a.y);
  if (direction < 0) return false;
  const std::uint8_t flags = edges_[static_cast<std::size_t>(ground_->PostAt(a))];
  return (flags >> static_cast<unsigned>(2 * direction + bit) & 1U) != 0;
}

void LevelRules::BeginExact(float most_m) {
  exact_ = true;
  most_m_ = most_m;
}

void LevelRules::BeginSoft(const HalfEdgeMesh& mesh) {
  exact_ = false;
  most_m_ = std::numeric_limits<float>::infinity();
  const std::vector<std::int32_t> kept = KeptIn(mesh);
  std::size_t next = 0;
  for (std::size_t e = 0; e < horizon_->edges.size(); ++e) {
    const bool has = next < kept.size() && kept[next] == static_cast<std::int32_t>(e);
    if (has) {
      ++next;
      continue;
    }
    int shift = 0;
    std::uint8_t* flags = FlagsOf(horizon_->edges[e].edge.a, horizon_->edges[e].edge.b, shift);
    *flags = static_cast<std::uint8_t>(*flags | 2U << static_cast<unsigned>(shift));
  }
}

Point3i LevelRules::Scaled(const Place& place) const {
  const FinerHeights& scale = guard_.scale();
  const Dem& dem = ground_->terrain().dem();
  const VertexId post = ground_->PostAt(place);
  if (ground_->IsOwn(place)) return scale.Scale(ground_->terrain().Point(post));
  const double quanta =
      (ground_->base_m() - dem.height_offset_m + static_cast<double>(place.plan)) / dem.quantum_m;
  const double steps = std::nearbyint(std::ldexp(quanta - scale.zero, scale.bits));
  return {place.x, place.y, static_cast<std::int32_t>(steps)};
}

double LevelRules::HeightM(const Place& place) const {
  const Dem& dem = ground_->terrain().dem();
  if (ground_->IsOwn(place)) return dem.HeightM(ground_->PostAt(place));
  const FinerHeights& scale = guard_.scale();
  return dem.height_offset_m + (scale.zero + scale.Quanta(Scaled(place).z)) * dem.quantum_m;
}

bool LevelRules::Allows(const Place& p, const Place& q) const {
  if (Has(p, q, 1)) return false;
  return !exact_ || guard_.IsOccluded({Scaled(p), Scaled(q)});
}

std::vector<std::int32_t> LevelRules::KeptIn(const HalfEdgeMesh& mesh) const {
  std::vector<Edge> edges;
  for (std::int32_t h = 0; h < mesh.half_edges(); ++h) {
    if (!mesh.Stands(h / 3) || mesh.twin(h) > h) continue;
    const Place& p = mesh.at(mesh.origin(h));
    const Place& q = mesh.at(mesh.origin(HalfEdgeMesh::Next(h)));
    if (Has(p, q, 0)) edges.push_back(MakeEdge(ground_->PostAt(p), ground_->PostAt(q)));
  }
  std::sort(edges.begin(), edges.end());
  std::vector<std::int32_t> kept;
  std::size_t next = 0;
  for (std::size_t e = 0; e < horizon_->edges.size() && next < edges.size(); ++e) {
    if (horizon_->edges[e].edge != edges[next]) continue;
    kept.push_back(static_cast<std::int32_t>(e));
    ++next;
  }
  return kept;
}

}  // namespace farhorizon
