#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "core/horizon/kinetic/hulls/kinetic_point.h"
#include "core/horizon/kinetic/hulls/step_marks.h"
#include "core/horizon/kinetic/hulls/sweep_depth.h"

namespace farhorizon::kinetic {

/// The certificates of [BaschGuibasHershberger97] at a node of the tree, by what they compare
/// ([Archambault03, section 2.2.2 and figure 2.6]).
enum class ChainCertificate : std::uint8_t {
  kX,         ///< x: the order of two edges of different chains by direction
  kBridge,    ///< yli, yri: an edge beside a bridge, and the point of the other chain there
  kTangentY,  ///< yt: an edge, and the point of the other chain that is nearest below it
  kTangentS,  ///< slt, srt: that point is between the ends of the edge
  kSlope,     ///< sl, sr: the other chain only falls behind, or only catches up, beside an edge
};
inline constexpr std::size_t kChainCertificates = 5;

/// Two chains and their common upper hull.
struct ChainMerge {
  std::vector<PointId> chain;
  std::optional<SweepDepth> failure;  ///< of the certificate that is the first to fail
  ChainCertificate failing = ChainCertificate::kX;
  std::array<std::int64_t, kChainCertificates> certificates{};
};

/// The upper hull of two upper hulls just after `now`, with the certificates that prove it. Each is
/// the sequence of its strict corners from the left to the right; sense -1: as seen with the plan
/// turned by half a turn, so that lower hulls are meant.
/// Cost: O(a + b) for chains of a and b corners.
class ChainMerger {
 public:
  /// Requires: `points` outlives it.
  ChainMerger(std::span<const KineticPoint> points, const SweepDepth& now, int sense)
      : points_(points), now_(now), sense_(sense) {}

  [[nodiscard]] ChainMerge Merge(std::span<const PointId> red, std::span<const PointId> blue);

 private:
  // An edge of one of the two chains, and the corner of the other one that is furthest out there.
  struct ChainEdge {
    PointId from;
    PointId to;
    PointId other;
    bool red;
    bool on_top;  // whether `other` is not above the line of the edge
  };

  [[nodiscard]] const MovingPoint& path(PointId p) const { return points_[Index(p)].path; }
  [[nodiscard]] int Orient(PointId a, PointId b, PointId c) const {
    return OrientAfter(path(a), path(b), path(c), now_);
  }
  // -1: a is before b, from the left to the right.
  [[nodiscard]] int Order(PointId a, PointId b) const {
    return sense_ * OrderAfter(path(a), path(b), now_);
  }
  [[nodiscard]] Quadratic TurnOf(const ChainEdge& a, const ChainEdge& b) const;
  void FindChain(std::span<const PointId> red, std::span<const PointId> blue);
  void FindEdges(std::span<const PointId> red, std::span<const PointId> blue);
  void CertifyX();
  void CertifyBridges(bool red_is_first, bool red_is_last);
  void CertifyTop();
  void CertifyY(ChainCertificate kind, const ChainEdge& edge);
  void CertifyOrder(ChainCertificate kind, PointId left, PointId right);
  void Note(ChainCertificate kind, const std::optional<SweepDepth>& at);

  std::span<const KineticPoint> points_;
  const SweepDepth& now_;
  int sense_;
  std::vector<ChainEdge> edges_;  // of both chains, in order of direction
  ChainMerge result_;
};

}  // namespace farhorizon::kinetic
