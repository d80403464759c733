#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <queue>
#include <vector>

#include "core/horizon/kinetic/hulls/sweep_depth.h"

namespace farhorizon::kinetic {

/// What a certificate proves, and whose it is: the meaning of its id.
enum class CertificateKind : std::uint8_t {
  kHull,      ///< a corner turns left strictly; id: PointId
  kInterior,  ///< an interior point is in its triangle; id: PointId
  kTangent,   ///< a tangent separates two hulls; id: TangentId
  kTree,      ///< the hull of a node of a tree is that of its children; id: HullForest has it
  kCover,     ///< hulls occlude all lines that touch a hull at a corner; id: PointId
};

/// The failure of a certificate. It is stale if the certificate was scheduled or cancelled since.
struct Event {
  SweepDepth at;
  CertificateKind kind = CertificateKind::kHull;
  std::uint32_t stamp = 0;
  std::int32_t id = 0;
};

/// When certificates fail: the event queue of a kinetic data structure [Archambault03, chapter 3].
///
/// A certificate is a predicate that is true until its event in the queue. It has a stamp, which
/// grows with each change; an event whose stamp is older than the certificate's is stale and is
/// dropped when it comes to the front. So a certificate has at most one event that is not stale,
/// and to cancel one costs no search.
/// Cost: O(log n) for each event, stale ones included.
class CertificateQueue {
 public:
  /// Replaces the event of a certificate. at: none if it never fails.
  void Schedule(CertificateKind kind, std::int32_t id, const std::optional<SweepDepth>& at);
  void Cancel(CertificateKind kind, std::int32_t id);

  /// The depth of the first event, once the stale ones before it are dropped.
  std::optional<SweepDepth> NextDepth();
  /// Takes one of the events at `now` out of the queue and cancels its certificate; nullopt: none
  /// is left. Requires: no earlier event is in the queue; throws InternalError otherwise.
  std::optional<Event> PopAt(const SweepDepth& now);

  /// Whether the certificate was ever scheduled or cancelled.
  [[nodiscard]] bool WasUsed(CertificateKind kind, std::int32_t id) const;
  /// How many certificates have an event to come.
  [[nodiscard]] std::int64_t pending() const { return pending_; }

 private:
  struct Certificate {
    std::uint32_t stamp = 0;
    bool pending = false;
  };
  struct Later {
    bool operator()(const Event& a, const Event& b) const { return Compare(a.at, b.at) > 0; }
  };
  Certificate& At(CertificateKind kind, std::int32_t id);
  void Cancel(Certificate& certificate);

  std::array<std::vector<Certificate>, 5> certificates_;  // by kind, then by id
  std::priority_queue<Event, std::vector<Event>, Later> events_;
  std::int64_t pending_ = 0;
};

}  // namespace farhorizon::kinetic
