#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "core/horizon/kinetic/bitangents/corner_order.h"
#include "core/horizon/kinetic/bitangents/tangent_certificates.h"
#include "core/horizon/kinetic/bitangents/tangent_table.h"
#include "core/horizon/kinetic/hulls/kinetic_hulls.h"
#include "core/horizon/kinetic/hulls/step_marks.h"

namespace farhorizon::kinetic {

/// The certificate of two half tangents at one corner has failed: they have come in line.
struct CollinearPair {
  HalfTangentId half;
  std::size_t which;              ///< of the certificates of `half`
  HalfTangentId partner;          ///< then
  std::array<PointId, 3> points;  ///< the corner and the other ends
};

/// Three corners of three hulls in line: algorithm 3.2 of [Archambault03].
///
/// At each of the corners two of the three tangents between them change places in the order there.
/// All three tangents change their activity (figure 3.12 of the thesis). At a corner, two active
/// ones close the visual gap between them, an active one gives its place to an inactive one, or two
/// inactive ones open a visual gap. For example, where Q rises between P and R:
///
///      pr is active, pq and qr are not         pq and qr are active, pr is not
///                                                          q
///        p - - - - - - - - - r                    p  . '(     )' .  r
///      (   )       q       (   )                (   )   (  Q  )   (   )
///      ( P )     (   )     ( R )                ( P )   (     )   ( R )
///      (   )     ( Q )     (   )                (   )             (   )
///
/// pr gives its place to pq at p and to qr at r, and pq and qr open a visual gap at q. Where Q
/// sinks, they close it; where Q comes down on pr from above, three gaps close.
///
/// Where that is all that happens at a depth, it is done in place: O(log n) for n certificates,
/// however many half tangents defer to the three; but where a gap is opened, all that are in the
/// occluded gap around it are looked up (lemma 3.13 of the thesis). Else the corners are marked
/// stale.
class CollinearEvents {
 public:
  /// Requires: all outlive it.
  CollinearEvents(const KineticHulls& hulls, const TangentTable& tangents,
                  TangentCertificates& certificates, CornerOrder& order, StepMarks& marks)
      : hulls_(hulls),
        tangents_(tangents),
        certificates_(certificates),
        order_(order),
        marks_(marks) {}

  void Add(const CollinearPair& pair) { pairs_.push_back(pair); }
  /// Whether all pairs are of the same three corners.
  [[nodiscard]] bool AreOne() const;
  /// Marks the ends of tangents that do not support their hulls any more as displaced: a half
  /// tangent that passes an active one may cross an edge of the hull together with it, and with
  /// those that deferred to it.
  void MarkDisplaced();
  /// Does the exchanges in place where the corners are as figure 3.12 has them, and marks them
  /// stale elsewhere. No pair is left. Requires: nothing else happens at this depth.
  void Exchange();
  /// Marks all corners stale. No pair is left.
  void MarkStale();

 private:
  // The two half tangents at one of the three corners.
  struct Meeting {
    PointId corner;
    HalfTangentId first;
    HalfTangentId second;
  };
  [[nodiscard]] std::optional<std::array<Meeting, 3>> MeetingsOf(const CollinearPair& pair) const;
  [[nodiscard]] bool ExchangeThree(const CollinearPair& pair);
  [[nodiscard]] bool IsPending(const CollinearPair& pair) const;
  [[nodiscard]] std::size_t ActiveIndex(PointId p, HalfTangentId active) const;
  [[nodiscard]] std::optional<std::size_t> PlaceToOpen(const Meeting& meeting) const;
  [[nodiscard]] std::optional<std::size_t> PlaceToClose(const Meeting& meeting) const;
  [[nodiscard]] std::optional<std::size_t> PlaceToReplace(const Meeting& meeting) const;
  [[nodiscard]] std::optional<std::size_t> PlaceOf(const Meeting& meeting) const;
  void CloseGap(PointId p, std::size_t index);
  void Replace(const Meeting& meeting, std::size_t index);
  void OpenGap(const Meeting& meeting, std::size_t index);
  void MarkStale(const CollinearPair& pair);

  const KineticHulls& hulls_;
  const TangentTable& tangents_;
  TangentCertificates& certificates_;
  CornerOrder& order_;
  StepMarks& marks_;
  std::vector<CollinearPair> pairs_;
};

}  // namespace farhorizon::kinetic
