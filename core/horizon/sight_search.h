#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "core/exact/quadratic.h"
#include "core/horizon/cover_certificate.h"
#include "core/horizon/segment_index.h"
#include "core/horizon/sight_sample.h"
#include "core/horizon/skyline.h"

namespace farhorizon {

/// What one point of a segment told: a sight, or a range around it that is hidden.
struct SightFinding {
  std::optional<Witness> sight;
  /// The middle of the free directions around the sight, about: columns and rows.
  std::array<double, 2> middle = {};
  HiddenRange hidden;
};

/// Asks points of one segment whether they can be sighted over the members of an index, in the numbers
/// that each needs. What hid one point is tried first at the next.
class SightSearch {
 public:
  /// except, hints, blockers, counts: as Skyline::FindSight. All of them must outlive the search.
  SightSearch(const SegmentIndex& index, const Segment& segment, Ties ties,
              std::optional<std::int32_t> except, const SightHints& hints,
              std::vector<std::int32_t>* blockers, PredicateCounts* counts);
  SightSearch(const SightSearch&) = delete;
  SightSearch& operator=(const SightSearch&) = delete;

  /// t: as Sighted counts it, from the lower end; in [0, 1]. Exact.
  SightFinding LookAt(const WideDyadic& t);

  /// Whether a witness at t can be said in a double.
  [[nodiscard]] bool FitsDouble(const WideDyadic& t) const;

 private:
  template <typename Int>
  SightFinding LookWith(BasicSightSample<Int>& sample, const BasicDyadic<Int>& t);

  const SegmentIndex& index_;
  bool from_high_;  // the lower end is the segment's second
  Sighted sighted_;
  std::optional<std::int32_t> except_;
  const SightHints& hints_;
  std::vector<std::int32_t> likely_;
  std::vector<std::int32_t> chain_;
  std::vector<std::int32_t>* blockers_;
  PredicateCounts* counts_;
  ShortSightSample short_sample_;
};

/// Whether a double and two integers that others' JSON reads exactly say it all.
bool IsPlain(const Witness& witness);
/// Whether a says its line in fewer digits.
bool Simpler(const Witness& a, const Witness& b);

}  // namespace farhorizon
