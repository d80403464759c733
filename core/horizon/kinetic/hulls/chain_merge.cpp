// In the dual plane of [BaschGuibasHershberger97] a point is a line with its x for a slope, an edge
// of an upper hull is a vertex of an upper envelope, and edges from the left to the right are
// vertices by their x. What is said of the red and the blue chain there, in words of the plan:
//
//           . q              An edge pq and the corner c of the other chain at which a line along
//       .       c            pq touches that chain: the line of the edge is above c, or below it.
//     p                      So of each two neighbouring edges, in order of direction, either the
//                            same chain is further out at both, or a bridge is between them.
//
// The distance of the outer chain from the inner one changes with the direction; it can have a
// least value only at an edge pq of the outer chain with c between p and q. There yt proves that
// it is not negative, slt and srt that the least value is there. Everywhere else sl and sr prove
// that it falls to the left of such an edge, or to its right, wherever the corner of the other
// chain changes; and beside bridges yli and yri prove which chain is further out. The two ends of
// the chains have an order each (kSlope). So the certificates prove the common hull
// [BaschGuibasHershberger97; Archambault03, section 3.2.4].
#include "core/horizon/kinetic/hulls/chain_merge.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace farhorizon::kinetic {

namespace {

// The first depth before end at which q, which is not negative now, becomes so. A quadratic is on
// an interval at least the least of its Bernstein coefficients; floating point is sure of most.
std::optional<SweepDepth> FirstFailure(const Quadratic& q, const SweepDepth& now,
                                       std::int64_t end) {
  const auto c0 = static_cast<double>(q.c0);
  const auto c1 = static_cast<double>(q.c1);
  const auto c2 = static_cast<double>(q.c2);
  const double first = now.lo;
  const auto last = static_cast<double>(end);
  const auto holds = [&](double a, double b) {
    const double value = c0 + c1 * (a + b) / 2 + c2 * a * b;
    const double size = std::fabs(c0) + std::fabs(c1) * (a + b) / 2 + std::fabs(c2) * a * b;
    return value > size * 0x1p-48;  // three terms of two roundings at most, and two sums
  };
  if (holds(first, first) && holds(first, last) && holds(last, last)) return std::nullopt;
  return FailureAfter(q, now, end);
}

Quadratic Negative(const Quadratic& q) { return {-q.c0, -q.c1, -q.c2}; }

// x_b - x_a times both denominators.
Quadratic StepX(const MovingPoint& a, const MovingPoint& b) {
  return {Int128{b.x} * a.d - Int128{a.x} * b.d, Int128{b.vx} * a.d - Int128{a.vx} * b.d, 0};
}
Quadratic StepY(const MovingPoint& a, const MovingPoint& b) {
  return {Int128{b.y} * a.d - Int128{a.y} * b.d, Int128{b.vy} * a.d - Int128{a.vy} * b.d, 0};
}

}  // namespace

// The cross product of two edges: negative where b turns right after a.
Quadratic ChainMerger::TurnOf(const ChainEdge& a, const ChainEdge& b) const {
  const Quadratic ax = StepX(path(a.from), path(a.to));
  const Quadratic ay = StepY(path(a.from), path(a.to));
  const Quadratic bx = StepX(path(b.from), path(b.to));
  const Quadratic by = StepY(path(b.from), path(b.to));
  return {ax.c0 * by.c0 - ay.c0 * bx.c0,
          ax.c0 * by.c1 + ax.c1 * by.c0 - ay.c0 * bx.c1 - ay.c1 * bx.c0,
          ax.c1 * by.c1 - ay.c1 * bx.c1};
}

ChainMerge ChainMerger::Merge(std::span<const PointId> red, std::span<const PointId> blue) {
  result_ = {};
  if (red.empty() || blue.empty()) {
    const std::span<const PointId> all = red.empty() ? blue : red;
    result_.chain.assign(all.begin(), all.end());
    return std::move(result_);
  }
  FindChain(red, blue);
  FindEdges(red, blue);
  const int first = Order(red.front(), blue.front());
  const int last = Order(red.back(), blue.back());
  CertifyOrder(ChainCertificate::kSlope, first <= 0 ? red.front() : blue.front(),
               first <= 0 ? blue.front() : red.front());
  CertifyOrder(ChainCertificate::kSlope, last <= 0 ? red.back() : blue.back(),
               last <= 0 ? blue.back() : red.back());
  CertifyX();
  CertifyBridges(first <= 0, last >= 0);
  CertifyTop();
  return std::move(result_);
}

// Andrew's chain over the corners of both, which are in order already.
void ChainMerger::FindChain(std::span<const PointId> red, std::span<const PointId> blue) {
  std::vector<PointId>& chain = result_.chain;
  std::size_t i = 0;
  std::size_t k = 0;
  while (i < red.size() || k < blue.size()) {
    const bool take_red = k == blue.size() || (i < red.size() && Order(red[i], blue[k]) <= 0);
    const PointId p = take_red ? red[i++] : blue[k++];
    if (!chain.empty() && Order(chain.back(), p) == 0) continue;  // they are one for ever
    while (chain.size() >= 2 && Orient(chain[chain.size() - 2], chain.back(), p) >= 0) {
      chain.pop_back();
    }
    chain.push_back(p);
  }
}

// Edges turn right along an upper hull. Of parallel ones, red is first.
void ChainMerger::FindEdges(std::span<const PointId> red, std::span<const PointId> blue) {
  edges_.clear();
  std::size_t i = 0;
  std::size_t k = 0;
  while (i + 1 < red.size() || k + 1 < blue.size()) {
    ChainEdge edge{-1, -1, -1, true, true};
    const bool has_red = i + 1 < red.size();
    const bool has_blue = k + 1 < blue.size();
    const ChainEdge next_red{has_red ? red[i] : -1, has_red ? red[i + 1] : -1, blue[k], true, true};
    const ChainEdge next_blue{has_blue ? blue[k] : -1, has_blue ? blue[k + 1] : -1, red[i], false,
                              true};
    if (!has_blue || (has_red && SignAfter(TurnOf(next_red, next_blue), now_) <= 0)) {
      edge = next_red;
      ++i;
    } else {
      edge = next_blue;
      ++k;
    }
    edge.on_top = Orient(edge.from, edge.to, edge.other) <= 0;
    edges_.push_back(edge);
  }
}

void ChainMerger::CertifyX() {
  for (std::size_t i = 1; i < edges_.size(); ++i) {
    const ChainEdge& a = edges_[i - 1];
    const ChainEdge& b = edges_[i];
    if (a.red == b.red) continue;
    const std::int64_t end = std::min({points_[Index(a.from)].end, points_[Index(a.to)].end,
                                       points_[Index(b.from)].end, points_[Index(b.to)].end});
    Note(ChainCertificate::kX, FirstFailure(Negative(TurnOf(a, b)), now_, end));
  }
}

void ChainMerger::CertifyBridges(bool red_is_first, bool red_is_last) {
  for (std::size_t i = 0; i <= edges_.size(); ++i) {
    const auto red_on_top = [&](std::size_t at) { return edges_[at].red == edges_[at].on_top; };
    const bool before = i == 0 ? red_is_first : red_on_top(i - 1);
    const bool after = i == edges_.size() ? red_is_last : red_on_top(i);
    if (before == after) continue;
    if (i > 0) CertifyY(ChainCertificate::kBridge, edges_[i - 1]);
    if (i < edges_.size()) CertifyY(ChainCertificate::kBridge, edges_[i]);
  }
}

void ChainMerger::CertifyTop() {
  for (std::size_t i = 0; i < edges_.size(); ++i) {
    const ChainEdge& edge = edges_[i];
    if (!edge.on_top) continue;
    const bool after_from = Order(edge.from, edge.other) <= 0;
    const bool before_to = Order(edge.other, edge.to) <= 0;
    if (after_from && before_to) {
      CertifyY(ChainCertificate::kTangentY, edge);
      CertifyOrder(ChainCertificate::kTangentS, edge.from, edge.other);
      CertifyOrder(ChainCertificate::kTangentS, edge.other, edge.to);
    } else if (after_from) {
      if (i + 1 < edges_.size() && edges_[i + 1].red != edge.red) {
        CertifyOrder(ChainCertificate::kSlope, edge.to, edge.other);
      }
    } else if (i > 0 && edges_[i - 1].red != edge.red) {
      CertifyOrder(ChainCertificate::kSlope, edge.other, edge.from);
    }
  }
}

void ChainMerger::CertifyY(ChainCertificate kind, const ChainEdge& edge) {
  const KineticPoint& from = points_[Index(edge.from)];
  const KineticPoint& to = points_[Index(edge.to)];
  const KineticPoint& other = points_[Index(edge.other)];
  Note(kind, TurnFailureAfter({from.path, to.path, other.path}, edge.on_top ? -1 : 1, now_,
                              std::min({from.end, to.end, other.end})));
}

// By x; where that is one for ever, by y.
void ChainMerger::CertifyOrder(ChainCertificate kind, PointId left, PointId right) {
  Quadratic step = StepX(path(left), path(right));
  if (step.c0 == 0 && step.c1 == 0) step = StepY(path(left), path(right));
  if (sense_ < 0) step = Negative(step);
  Note(kind,
       FirstFailure(step, now_, std::min(points_[Index(left)].end, points_[Index(right)].end)));
}

void ChainMerger::Note(ChainCertificate kind, const std::optional<SweepDepth>& at) {
  ++result_.certificates[static_cast<std::size_t>(kind)];
  if (!at || (result_.failure && Compare(*at, *result_.failure) >= 0)) return;
  result_.failure = at;
  result_.failing = kind;
}

}  // namespace farhorizon::kinetic
