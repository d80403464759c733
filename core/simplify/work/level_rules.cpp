// In whole steps of the guard's scale, so that no rule depends on rounding. A horizon edge is two
// bits at its earlier post, for each of four directions to a later one. A new edge is asked what
// costs least first: the bits and the lines of the parts; whether it runs below the spokes whose
// place it takes; then a search for an occluder, which begins with what occluded the last edge
// nearby.
#include "core/simplify/work/level_rules.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "core/exact/int128.h"

namespace farhorizon {

namespace {

// Columns and rows of a block of posts that shares one list of likely occluders: what is near has
// the same ridges around it. Any size is sound.
constexpr std::int32_t kBlock = 8;

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
  likely_.resize(static_cast<std::size_t>(ground.columns() / kBlock + 1) *
                 static_cast<std::size_t>(ground.rows() / kBlock + 1));
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

void LevelRules::BeginExact(double rise_m) {
  exact_ = true;
  rise_steps_ = guard_.scale().Steps(rise_m / ground_->terrain().dem().quantum_m);
}

void LevelRules::BeginSoft(const HalfEdgeMesh& mesh) {
  exact_ = false;
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

bool LevelRules::IsOccluded(const Place& p, const Place& q) const {
  const std::int32_t columns = ground_->columns() / kBlock + 1;
  const std::int32_t block = (p.y + q.y) / (2 * kBlock) * columns + (p.x + q.x) / (2 * kBlock);
  return !Rises(p, q, likely_[static_cast<std::size_t>(block)]);
}

bool LevelRules::Allows(const Place& p, const Place& q) const {
  if (IsBarred(p, q)) return false;
  return !exact_ || trusts_ || IsOccluded(p, q);
}

bool LevelRules::AllowsChord(const Ring& ring, const Place& centre, std::int32_t i,
                             std::int32_t j) const {
  if (IsBarred(ring.at(i), ring.at(j))) return false;
  return !exact_ || trusts_ || RunsBelow(ring, centre, i, j) || IsOccluded(ring.at(i), ring.at(j));
}

bool LevelRules::AllowsMove(const Place& from, const Place& to, const Place& other) const {
  if (IsBarred(to, other)) return false;
  const bool lowered = from.x == to.x && from.y == to.y && to.plan <= from.plan;
  return !exact_ || lowered || guard_.IsSurelyOccluded(LoweredEdge(to, other));
}

// A chord of a ring that its centre sees whole crosses the spokes to the places on its other side,
// and no others. It is straight between, as the surface is.
bool LevelRules::RunsBelow(const Ring& ring, const Place& centre, std::int32_t i,
                           std::int32_t j) const {
  const Segment chord = {Scaled(ring.at(i)), Scaled(ring.at(j))};
  const Point3i middle = Scaled(centre);
  const std::int64_t side = Turn(ring.at(i), ring.at(j), centre);
  if (side == 0) {
    // The chord passes through the centre: between its ends by the longer of both steps.
    const bool by_column = std::abs(chord.b.x - chord.a.x) >= std::abs(chord.b.y - chord.a.y);
    const std::int64_t whole = by_column ? chord.b.x - chord.a.x : chord.b.y - chord.a.y;
    const std::int64_t part = by_column ? middle.x - chord.a.x : middle.y - chord.a.y;
    const Int128 at_centre = Int128{chord.a.z} * (whole - part) + Int128{chord.b.z} * part;
    return whole > 0 ? at_centre <= Int128{middle.z} * whole
                     : at_centre >= Int128{middle.z} * whole;
  }
  // The places in turning order from i to j lie to the negative side of i -> j.
  const std::int32_t from = side > 0 ? i : j;
  const std::int32_t to = side > 0 ? j : i;
  if (!ring.closed && from > to) return false;
  for (std::int32_t k = ring.after(from); k != to; k = ring.after(k)) {
    const std::int64_t of_place = std::abs(side);
    const std::int64_t of_centre = std::abs(Turn(ring.at(i), ring.at(j), ring.at(k)));
    const std::int64_t of_a = std::abs(Turn(centre, ring.at(k), ring.at(j)));
    const std::int64_t of_b = std::abs(Turn(centre, ring.at(k), ring.at(i)));
    const Int128 spoke = Int128{of_centre} * middle.z + Int128{of_place} * Scaled(ring.at(k)).z;
    const Int128 height = Int128{of_a} * chord.a.z + Int128{of_b} * chord.b.z;
    if (height * (of_centre + of_place) > spoke * (of_a + of_b)) return false;
  }
  return true;
}

std::vector<std::int32_t> LevelRules::KeptIn(const HalfEdgeMesh& mesh) const {
  std::vector<Edge> edges;
  for (std::int32_t h = 0; h < mesh.half_edges(); ++h) {
    if (!mesh.Stands(h / 3) || mesh.twin(h) > h) continue;
    const Place& p = mesh.at(mesh.origin(h));
    const Place& q = mesh.at(mesh.origin(HalfEdgeMesh::Next(h)));
    if (Has(p, q, 0) && !Has(p, q, 1))
      edges.push_back(MakeEdge(ground_->PostAt(p), ground_->PostAt(q)));
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
