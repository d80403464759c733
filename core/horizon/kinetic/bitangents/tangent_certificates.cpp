#include "core/horizon/kinetic/bitangents/tangent_certificates.h"

#include <utility>

namespace farhorizon::kinetic {

void TangentCertificates::Certify(HalfTangentId half, std::size_t which, HalfTangentId partner) {
  Half& certified = halves_[Index(half)];
  const HalfTangentId old = std::exchange(certified.partner[which], partner);
  if (old != partner) {
    if (old >= 0 && old != half) --halves_[Index(old)].deferred[which];
    if (partner >= 0 && partner != half) ++halves_[Index(partner)].deferred[which];
  }
  const Turn turn = TurnBetween(half, which, partner);
  if (turn == certified.turn[which]) return;
  certified.turn[which] = turn;
  if (partner == kHullEdge) ++edge_updates_;
  const auto id = 2 * half + static_cast<std::int32_t>(which);
  if (turn.sign == 0) {
    queue_.Cancel(CertificateKind::kTangent, id);
    return;
  }
  const auto [a, b, c] = turn.points;
  queue_.Schedule(
      CertificateKind::kTangent, id,
      TurnFailureAfter({hulls_.point(a).path, hulls_.point(b).path, hulls_.point(c).path},
                       turn.sign, hulls_.now(), hulls_.FirstEnd(turn.points)));
}

// Of directions at corner p, the one to b is after the one to a exactly if b is left of pa. The
// direction of a half tangent whose other hull is behind is the opposite of the one to its other
// end: that changes the sign. The edges of the hull are directed from its previous corner, to its
// next one.
TangentCertificates::Turn TangentCertificates::TurnBetween(HalfTangentId half, std::size_t which,
                                                           HalfTangentId partner) const {
  if (partner == half) return {};
  const PointId p = tangents_.Own(half);
  const PointId q = tangents_.Other(half);
  Turn turn;
  turn.sign = TangentTable::Ahead(half) ? 1 : -1;
  if (partner == kHullEdge) {
    const KineticPoint& corner = hulls_.point(p);
    turn.points = which == 0 ? std::array{corner.prev, p, q} : std::array{p, q, corner.next};
  } else {
    const PointId r = tangents_.Other(partner);
    turn.points = which == 0 ? std::array{p, r, q} : std::array{p, q, r};
    if (!TangentTable::Ahead(partner)) turn.sign = -turn.sign;
  }
  return turn;
}

bool TangentCertificates::Holds(HalfTangentId half, std::size_t which) const {
  const HalfTangentId with = partner(half, which);
  if (with == kHullEdge || with == half) return true;
  return which == 0 ? tangents_.Before(with, half) : tangents_.Before(half, with);
}

}  // namespace farhorizon::kinetic
