// Ranges of directions one by one. In each, most pieces are below the floor of the skyline on all lines of the strips that they reach. For the
// others the occluders that are high enough are sorted into wider strips, and those in a piece's
// strips are asked by boxes (OccludedLines).
// Cost: for each range one look at each piece; where pieces are left, one at each point and segment
// of the surface; then the boxes, which are limited.
#include "core/measure/skyline_bound.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <numeric>

#include "core/measure/mesh_error.h"

namespace farhorizon {

namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

// Room for a proof between what was attained and what is proven: with less, boxes get smaller.
constexpr double kRoom = 1.0 / 40;
// The same in heights of the surface, for an error of 0.
constexpr double kLeastRoom = 1e-7;
// How far below a lowered piece occluders are gathered, in allowances: the bound may be raised by
// that before they have to be gathered again.
constexpr double kGathered = 1.5;
// Strips of the occluders, in those of LineStrips. Any value is sound.
constexpr std::int32_t kWider = 4;
// Boxes for each piece and segment, and at least, before the search ends with what it has.
constexpr std::int64_t kMostBoxes = 200;
constexpr std::int64_t kLeastBoxes = 1'000'000;

// Strips that lines through something are in.
struct StripSpan {
  std::int32_t first = 0;
  std::int32_t last = 0;
};

class RaisedSearch {
 public:
  RaisedSearch(const OccludingSurface& surface, const SkylineFloor& floor, double floor_less_m,
               const std::vector<RaisedPiece>& pieces, const RaisedBounds& bounds)
      : surface_(surface),
        floor_(floor),
        floor_less_m_(floor_less_m),
        pieces_(pieces),
        bounds_(bounds),
        lines_(surface.net, surface.hull),
        spans_(surface.net.points.size()) {
    least_room_ = kLeastRoom * (1 + surface.relief_m);
    most_boxes_ =
        kLeastBoxes +
        kMostBoxes * static_cast<std::int64_t>(surface.net.segments.size() + pieces.size());
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
  struct Pending {
    std::size_t piece;
    StripSpan strips;
    double floor_m;  // occluders above this are gathered
  };

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
    const auto [least, most] = std::minmax(
        {strips.OffsetOf(p.a, range.first), strips.OffsetOf(p.a, range.last),
         strips.OffsetOf(p.b, range.first), strips.OffsetOf(p.b, range.last)});
    return {strips.StripOf(least - strips.slack), strips.StripOf(most + strips.slack)};
  }

  void SearchRange(int k) {
    const DirectionRange range = floor_.strips.Range(k);
    pending_.clear();
    for (std::size_t i = 0; i < pieces_.size(); ++i) {
      const RaisedPiece& piece = pieces_[i];
      const StripSpan strips = SpanOf(piece, range);
      const double known = floor_.Least(k, strips.first, strips.last) - floor_less_m_;
      if (known >= Highest(piece) - Allowed(piece.outline)) continue;
      pending_.push_back({i, strips, 0});
    }
    if (pending_.empty()) return;
    if (lines_.boxes() > most_boxes_) return GiveUp(k);
    PlacePoints(range);
    Gather();
    for (std::size_t i = 0; i < pending_.size(); ++i) {
      const double angle = std::numbers::pi / floor_.strips.directions;
      AskPiece(pending_[i], k * angle, (k + 1) * angle);
    }
  }

  // The bound becomes what is certain without a search.
  void GiveUp(int k) {
    for (const Pending& p : pending_) {
      const RaisedPiece& piece = pieces_[p.piece];
      const double known =
          std::max(floor_.Least(k, p.strips.first, p.strips.last) - floor_less_m_,
                   surface_.lowest_m);
      double& tolerated = Tolerated(piece.outline);
      tolerated = std::max(tolerated, Highest(piece) - known);
    }
  }

  void PlacePoints(const DirectionRange& range) {
    const LineStrips& strips = floor_.strips;
    for (std::size_t i = 0; i < spans_.size(); ++i) {
      const double first = strips.OffsetOf(surface_.net.points[i], range.first);
      const double last = strips.OffsetOf(surface_.net.points[i], range.last);
      spans_[i] = {strips.StripOf(std::min(first, last) - strips.slack),
                   strips.StripOf(std::max(first, last) + strips.slack)};
    }
  }

  [[nodiscard]] StripSpan SpanOf(const SkylineNet::Segment& s) const {
    const StripSpan& a = spans_[static_cast<std::size_t>(s.a)];
    const StripSpan& b = spans_[static_cast<std::size_t>(s.b)];
    return {std::min(a.first, b.first), std::max(a.last, b.last)};
  }
  [[nodiscard]] double HigherEnd(const SkylineNet::Segment& s) const {
    return std::max(surface_.net.Point(s.a).height_m, surface_.net.Point(s.b).height_m);
  }

  // Sorts the occluders that the pending pieces need into wider strips, falling in each.

  void Gather() {

    const std::int32_t count = floor_.strips.count / kWider + 1;
    needed_.assign(static_cast<std::size_t>(count), kInfinity);
    wide_.resize(static_cast<std::size_t>(count));
    for (std::vector<std::int32_t>& list : wide_) list.clear();
    double least = kInfinity;
    for (Pending& p : pending_) {
      const RaisedPiece& piece = pieces_[p.piece];
      p.floor_m = std::min(piece.a.height_m, piece.b.height_m) - kGathered * Allowed(piece.outline);
      least = std::min(least, p.floor_m);
      for (std::int32_t w = p.strips.first / kWider; w <= p.strips.last / kWider; ++w) {
        double& needed = needed_[static_cast<std::size_t>(w)];
        needed = std::min(needed, p.floor_m);
      }
    }
    for (const std::int32_t i : surface_.falling) {
      const SkylineNet::Segment& s = surface_.net.segments[static_cast<std::size_t>(i)];
      const double height = HigherEnd(s);
      if (height < least) break;
      const StripSpan span = SpanOf(s);
      for (std::int32_t w = span.first / kWider; w <= span.last / kWider; ++w) {
        if (height >= needed_[static_cast<std::size_t>(w)]) {
          wide_[static_cast<std::size_t>(w)].push_back(i);
        }
      }
    }
  }

  void CollectCandidates(const Pending& p) {
    candidates_.clear();
    const std::int32_t from = p.strips.first / kWider;
    for (std::int32_t w = from; w <= p.strips.last / kWider; ++w) {
      for (const std::int32_t i : wide_[static_cast<std::size_t>(w)]) {
        const SkylineNet::Segment& s = surface_.net.segments[static_cast<std::size_t>(i)];
        if (HigherEnd(s) < p.floor_m) break;
        const StripSpan span = SpanOf(s);
        if (span.last < p.strips.first || span.first > p.strips.last) continue;
        if (w != std::max(from, span.first / kWider)) continue;  // met in a strip before
        candidates_.push_back({surface_.net.Point(s.a), surface_.net.Point(s.b), s.a, s.b});
      }
    }
  }

  void AskPiece(Pending& p, double first, double last) {
    const RaisedPiece& piece = pieces_[p.piece];
    CollectCandidates(p);
    if (!piece.near_outline) return AskDirections(p, first, last);
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
      if (g - kGrazingAngle > first) {
        AskDirections(p, first, std::min(last, g - kGrazingAngle));
      }
      first = std::max(first, g + kGrazingAngle);
      if (first >= last) return;
    }
    AskDirections(p, first, last);
  }

  void AskDirections(Pending& p, double first, double last) {
    const RaisedPiece& piece = pieces_[p.piece];
    for (;;) {
      BoxQuestion question;
      question.box = {piece.a, piece.b, DirectionRange::Of(first, last)};
      question.tolerated_m = Tolerated(piece.outline);
      question.allowed_m = Allowed(piece.outline);
      question.floor_m = p.floor_m;
      const BoxVerdict verdict = lines_.Ask(question, candidates_);
      if (verdict.proven) return;

      Tolerated(piece.outline) =
          std::max(verdict.excess_m, Tolerated(piece.outline) + least_room_);
      const double lower_end = std::min(piece.a.height_m, piece.b.height_m);
      if (lower_end - Allowed(piece.outline) >= p.floor_m) continue;
      Gather();
      CollectCandidates(p);
    }
  }

  const OccludingSurface& surface_;
  const SkylineFloor& floor_;
  double floor_less_m_;
  const std::vector<RaisedPiece>& pieces_;
  RaisedBounds bounds_;
  double least_room_ = 0;
  std::int64_t most_boxes_ = 0;
  OccludedLines lines_;
  std::vector<StripSpan> spans_;  // of each point of the surface
  std::vector<Pending> pending_;
  std::vector<double> needed_;                   // per wider strip
  std::vector<std::vector<std::int32_t>> wide_;  // segments of each
  std::vector<Occluder> candidates_;
};

}  // namespace

double WithRoom(double attained_m, double relief_m) {
  return attained_m * (1 + kRoom) + kLeastRoom * (1 + relief_m);
}

OccludingSurface OccludingSurface::Of(SkylineNet net) {
  OccludingSurface surface;
  surface.hull = NetHull::Of(net);
  surface.falling.resize(net.segments.size());
  std::iota(surface.falling.begin(), surface.falling.end(), 0);
  const auto height = [&net](std::int32_t i) {
    const SkylineNet::Segment& s = net.segments[static_cast<std::size_t>(i)];
    return std::max(net.Point(s.a).height_m, net.Point(s.b).height_m);
  };
  std::sort(surface.falling.begin(), surface.falling.end(), [&](std::int32_t i, std::int32_t j) {
    const double at_i = height(i);
    const double at_j = height(j);
    return at_i > at_j || (at_i == at_j && i < j);
  });
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
                                 double floor_less_m, const std::vector<RaisedPiece>& pieces,
                                 const RaisedBounds& bounds, const RunControl& control) {
  return RaisedSearch(surface, floor, floor_less_m, pieces, bounds).Run(control);
}

}  // namespace farhorizon
