#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "core/horizon/kinetic/bitangents/tangent_table.h"
#include "core/horizon/kinetic/hulls/certificate_queue.h"
#include "core/horizon/kinetic/hulls/kinetic_hulls.h"

namespace farhorizon::kinetic {

/// The certificates of half tangents: each has one towards what is before it at its corner, in
/// order of direction, and one towards what is after it (`which` 0 and 1).
///
/// A certificate proves the order of a half tangent and its *partner*: another half tangent at the
/// same corner, or the edge of the hull (kHullEdge). If the partner is the half tangent itself,
/// there is no certificate: the one after it has it. An order at a corner is the orientation of
/// three corners, so the certificate fails where three corners come in line.
///
/// The thesis certifies an inactive tangent with the border of its gap [Archambault03, section
/// 3.2.3 and figure 3.1] and, where an active and an inactive tangent change places, gives all
/// certificates of the one to the other. Here these stay and are *deferred*: the tangent that lost
/// its place is certified with its successor, and so are, through it, all that have it as their
/// partner. That is the tournament that chapter 5 of the thesis asks for: an exchange costs O(log
/// n) for n certificates, whatever the number of hulls.
class TangentCertificates {
 public:
  /// Requires: all outlive it.
  TangentCertificates(CertificateQueue& queue, const KineticHulls& hulls,
                      const TangentTable& tangents)
      : queue_(queue), hulls_(hulls), tangents_(tangents) {}

  /// Makes room for all of the table's tangents.
  void Resize() { halves_.resize(Index(tangents_.half_count())); }
  /// For a half tangent that is made.
  void ClearDeferred(HalfTangentId half) { halves_[Index(half)].deferred = {}; }
  /// For a half tangent that is dropped.
  void ClearPartners(HalfTangentId half) { halves_[Index(half)].partner = {kHullEdge, kHullEdge}; }

  /// Certifies the present order of `half` and `partner`; none where `partner` is `half`. Costs
  /// nothing where the three corners are the same as before.
  void Certify(HalfTangentId half, std::size_t which, HalfTangentId partner);
  /// Takes note that the certificate has failed, as its points are in line.
  void Fail(HalfTangentId half, std::size_t which) { halves_[Index(half)].turn[which] = {}; }

  [[nodiscard]] HalfTangentId partner(HalfTangentId half, std::size_t which) const {
    return halves_[Index(half)].partner[which];
  }
  /// Whether it is certified: neither failed nor left to the one after it.
  [[nodiscard]] bool IsCertified(HalfTangentId half, std::size_t which) const {
    return halves_[Index(half)].turn[which].sign != 0;
  }
  /// The three corners. Requires: IsCertified().
  [[nodiscard]] const std::array<PointId, 3>& points(HalfTangentId half, std::size_t which) const {
    return halves_[Index(half)].turn[which].points;
  }
  /// How many half tangents have it as their partner before (0) or after (1) them.
  [[nodiscard]] std::int32_t deferred(HalfTangentId half, std::size_t which) const {
    return halves_[Index(half)].deferred[which];
  }
  [[nodiscard]] bool HasDeferred(HalfTangentId half) const {
    return deferred(half, 0) != 0 || deferred(half, 1) != 0;
  }
  /// How often a certificate with an edge of the hull was made anew: lemma 4.12 of the thesis.
  [[nodiscard]] std::int64_t edge_updates() const { return edge_updates_; }
  /// Whether it and its partner are in order just after now.
  [[nodiscard]] bool Holds(HalfTangentId half, std::size_t which) const;

 private:
  /// sign times the orientation of the three is not negative while the certificate holds.
  struct Turn {
    std::array<PointId, 3> points{-1, -1, -1};
    int sign = 0;
    friend bool operator==(const Turn&, const Turn&) = default;
  };
  struct Half {
    std::array<Turn, 2> turn;
    std::array<HalfTangentId, 2> partner{kHullEdge, kHullEdge};
    std::array<std::int32_t, 2> deferred{};
  };
  [[nodiscard]] Turn TurnBetween(HalfTangentId half, std::size_t which,
                                 HalfTangentId partner) const;

  CertificateQueue& queue_;
  const KineticHulls& hulls_;
  const TangentTable& tangents_;
  std::vector<Half> halves_;
  std::int64_t edge_updates_ = 0;
};

}  // namespace farhorizon::kinetic
