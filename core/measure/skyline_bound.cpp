// Ranges of directions one by one. In each, most pieces are below the floor of the skyline on all
// lines of the strips that they reach. For the others the occluders that are high enough are
// gathered along their lines, and asked by boxes (OccludedLines).
// Cost: for each range one look at each piece; then the boxes, which are limited.
#include "core/measure/skyline_bound.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/base/infinity.h"
#include "core/measure/mesh_error.h"
#include "core/measure/mesh_sides.h"
#include "core/measure/segment_blocks.h"

namespace farhorizon {

namespace {

// Room for a proof between what was attained and what is proven: with less, boxes get smaller.
constexpr double kRoom = 1.0 / 40;
// The same in heights of the surface, for an error of 0.
constexpr double kLeastRoom = 1e-7;
// How far below a piece occluders are looked up, in allowances: more than 1, so that an error can
// be seen that is greater than what is allowed.
constexpr double kGathered = 1.5;
// Looks at segments for each piece and segment, and at least, before the search ends with what it
// has: some microseconds each. Levels of real ground take a tenth of it.
constexpr std::int64_t kLooksForEach = 500;
constexpr std::int64_t kLeastLooks = 50'000'000;

// Strips that lines through something are in.
struct StripSpan {
  std::int32_t first = 0;
  std::int32_t last = 0;
};

class RaisedSearch {
 public:
  RaisedSearch(const OccludingSurface& surface, const SkylineFloor& floor,
               const std::vector<RaisedPiece>& pieces, const RaisedBounds& bounds)
      : surface_(surface),
        floor_(floor),
        pieces_(pieces),
        bounds_(bounds),
        lines_(surface.net, surface.hull),
        blocks_(surface.net),
        proof_(pieces.size(), kNoneThere) {
    most_looks_ = kLeastLooks + kLooksForEach * static_cast<std::int64_t>(
                                                    surface.net.segments.size() + pieces.size());
  }

  Result<RaisedBounds> Run(const RunControl& control) {
    for (int k = 0; k < floor_.strips.directions; ++k) {
      if (control.StopRequested()) {
        return Error{ErrorCode::kCancelled, "stopped while bounding the silhouette"};
      }
      SearchRange(k);
    }
    return RaisedBounds{Allowed(false), Allowed(true)};
  }

 private:
  [[nodiscard]] double& Tolerated(bool outline) {
    return outline ? bounds_.outline_m : bounds_.inner_m;
  }
  // What is proven: more than what is tolerated.
  [[nodiscard]] double Allowed(bool outline) const {
    return WithRoom(outline ? bounds_.outline_m : bounds_.inner_m, surface_.relief_m);
  }

  static double Highest(const RaisedPiece& p) { return std::max(p.a.height_m, p.b.height_m); }

  [[nodiscard]] StripSpan SpanOf(const RaisedPiece& p, const DirectionRange& range) const {
    const LineStrips& strips = floor_.strips;
    const auto [least, most] =
        std::minmax({strips.OffsetOf(p.a, range.first), strips.OffsetOf(p.a, range.last),
                     strips.OffsetOf(p.b, range.first), strips.OffsetOf(p.b, range.last)});
    return {strips.StripOf(least - strips.slack), strips.StripOf(most + strips.slack)};
  }

  void SearchRange(int k) {
    const DirectionRange range = floor_.strips.Range(k);
    const double angle = std::numbers::pi / floor_.strips.directions;
    for (const RaisedPiece& piece : pieces_) {
      const StripSpan strips = SpanOf(piece, range);
      const double known = floor_.Least(k, strips.first, strips.last);
      if (known >= Highest(piece) - Allowed(piece.outline)) continue;
      if (lines_.looks() <= most_looks_ && AskPiece(piece, k * angle, (k + 1) * angle)) continue;
      // The bound becomes what is certain without a search.
      double& tolerated = Tolerated(piece.outline);
      tolerated = std::max(tolerated, Highest(piece) - std::max(known, surface_.lowest_m));
    }
  }

  // False where the search has come to no end.
  bool AskPiece(const RaisedPiece& piece, double first, double last) {
    if (!piece.near_outline) return AskDirections(piece, first, last);
    // Without the directions that graze an outline: those of the grid's, and the piece's own.
    const double own =
        piece.outline ? std::atan2(piece.b.row - piece.a.row, piece.b.column - piece.a.column) : 0;
    std::array<double, 6> grazed = {0,
                                    std::numbers::pi / 4,
                                    std::numbers::pi / 2,
                                    3 * std::numbers::pi / 4,
                                    std::numbers::pi,
                                    own < 0 ? own + std::numbers::pi : own};
    std::sort(grazed.begin(), grazed.end());
    for (const double g : grazed) {
      const double stop = std::min(last, g - kGrazingAngle);
      if (stop > first && !AskDirections(piece, first, stop)) return false;
      first = std::max(first, g + kGrazingAngle);
      if (first >= last) return true;
    }
    return AskDirections(piece, first, last);
  }

  bool AskDirections(const RaisedPiece& piece, double first, double last) {
    const double lower_end = std::min(piece.a.height_m, piece.b.height_m);
    BoxQuestion question;
    question.box = {piece.a, piece.b, DirectionRange::Of(first, last)};
    for (;;) {
      question.tolerated_m = Tolerated(piece.outline);
      question.allowed_m = Allowed(piece.outline);
      question.floor_m = lower_end - kGathered * question.allowed_m;
      lines_.Begin(question);
      if (ProvenAsBefore(piece)) return true;
      const auto offer = [this, &piece](std::int32_t segment) {
        if (!lines_.Offer(segment)) return false;
        latest_proof_ = ProofOf(piece) = segment;
        return true;
      };
      if (blocks_.Visit(question.box, question.floor_m, offer)) return true;
      const BoxVerdict verdict = lines_.Conclude();
      if (verdict.proven) return true;
      if (verdict.exhausted || lines_.looks() > most_looks_) return false;
      // Over a line that meets the surface a piece has no more than this: the line passes between
      // parts of a surface that holes have torn, and no height proves it.
      if (verdict.excess_m > Highest(piece) - surface_.lowest_m) return false;
      Tolerated(piece.outline) = verdict.excess_m;
    }
  }

  [[nodiscard]] std::int32_t& ProofOf(const RaisedPiece& piece) {
    return proof_[static_cast<std::size_t>(&piece - pieces_.data())];
  }
  // By the segment that occludes the piece in the directions before, or its neighbour in these.
  bool ProvenAsBefore(const RaisedPiece& piece) {
    for (const std::int32_t segment : {ProofOf(piece), latest_proof_}) {
      if (segment == kNoneThere || !lines_.ProvenBy(segment)) continue;
      latest_proof_ = ProofOf(piece) = segment;
      return true;
    }
    return false;
  }

  const OccludingSurface& surface_;
  const SkylineFloor& floor_;
  const std::vector<RaisedPiece>& pieces_;
  RaisedBounds bounds_;
  std::int64_t most_looks_ = 0;
  OccludedLines lines_;
  SegmentBlocks blocks_;
  std::vector<std::int32_t> proof_;  // per piece: the segment that proved it last
  std::int32_t latest_proof_ = kNoneThere;
};

}  // namespace

double WithRoom(double attained_m, double relief_m) {
  return attained_m * (1 + kRoom) + kLeastRoom * (1 + relief_m);
}

OccludingSurface OccludingSurface::Of(SkylineNet net) {
  OccludingSurface surface;
  surface.hull = NetHull::Of(net);
  double most = -kInfinity;
  surface.lowest_m = kInfinity;
  for (const SkylineNet::Segment& s : net.segments) {
    for (const std::int32_t i : {s.a, s.b}) {
      surface.lowest_m = std::min(surface.lowest_m, net.Point(i).height_m);
      most = std::max(most, net.Point(i).height_m);
    }
  }
  surface.relief_m = most - surface.lowest_m;
  surface.net = std::move(net);
  return surface;
}

Result<RaisedBounds> BoundRaised(const OccludingSurface& surface, const SkylineFloor& floor,
                                 const std::vector<RaisedPiece>& pieces, const RaisedBounds& bounds,
                                 const RunControl& control) {
  return RaisedSearch(surface, floor, pieces, bounds).Run(control);
}

}  // namespace farhorizon
