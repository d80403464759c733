#include "core/horizon/join_horizons.h"

#include <algorithm>
#include <tuple>
#include <utility>

#include "core/horizon/visibility/occluder_set.h"

namespace farhorizon {

namespace {

constexpr std::size_t kSegmentsBetweenChecks = 256;

auto Ends(const Segment& s) { return std::tuple(s.a.y, s.a.x, s.a.z, s.b.y, s.b.x, s.b.z); }

}  // namespace

Result<std::vector<std::size_t>> FindHorizonSegments(const std::vector<Segment>& segments,
                                                     std::int32_t columns, std::int32_t rows,
                                                     const RunControl& control) {
  OccluderSet occluders(columns, rows);
  for (const Segment& segment : segments) occluders.Insert(segment);
  std::vector<std::size_t> kept;
  for (std::size_t i = 0; i < segments.size(); ++i) {
    if (i % kSegmentsBetweenChecks == 0 && control.StopRequested()) {
      return Error{ErrorCode::kCancelled, "stopped while joining horizons"};
    }
    const auto self = static_cast<OccluderId>(i);
    if (occluders.FindLineOfSight({.segment = segments[i], .except = self}).witness) {
      kept.push_back(i);
    }
  }
  return kept;
}

Result<std::vector<Segment>> JoinHorizons(std::vector<Segment> a, const std::vector<Segment>& b,
                                          std::int32_t columns, std::int32_t rows,
                                          const RunControl& control) {
  a.insert(a.end(), b.begin(), b.end());
  for (Segment& segment : a) {
    if (Ends({segment.b, segment.a}) < Ends(segment)) std::swap(segment.a, segment.b);
  }
  std::sort(a.begin(), a.end(),
            [](const Segment& p, const Segment& q) { return Ends(p) < Ends(q); });
  a.erase(std::unique(a.begin(), a.end(),
                      [](const Segment& p, const Segment& q) { return Ends(p) == Ends(q); }),
          a.end());
  Result<std::vector<std::size_t>> kept = FindHorizonSegments(a, columns, rows, control);
  if (!kept) return std::move(kept.error());
  std::vector<Segment> joined;
  joined.reserve(kept->size());
  for (const std::size_t i : *kept) joined.push_back(a[i]);
  return joined;
}

}  // namespace farhorizon
