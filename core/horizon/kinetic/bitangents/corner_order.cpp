// The order at a corner is kept in place by small changes, or found anew from the depths, by one
// pass over the sorted half tangents (Rebuild) [Archambault03, sections 3.2.1, 3.2.3 and 3.2.5].
// All order is that of TangentTable::Before. Active bitangents are sorted, so that a place among
// them is found by bisection; inactive ones are not.
// Cost: O(log k) for a place among k active bitangents; O(k log n) for a Rebuild of k half
// tangents.
#include "core/horizon/kinetic/bitangents/corner_order.h"

#include <algorithm>
#include <array>
#include <cstddef>

#include "core/base/result.h"

namespace farhorizon::kinetic {

std::size_t CornerOrder::ActiveBefore(HalfTangentId half) const {
  const std::vector<HalfTangentId>& active = corner(tangents_.Own(half)).active_bitangents;
  const auto at = std::partition_point(active.begin(), active.end(), [&](HalfTangentId other) {
    return tangents_.Before(other, half);
  });
  return static_cast<std::size_t>(at - active.begin());
}

HalfTangentId CornerOrder::ActiveOrEdge(PointId p, std::size_t index) const {
  const std::vector<HalfTangentId>& active = corner(p).active_bitangents;
  return index < active.size() ? active[index] : kHullEdge;
}

void CornerOrder::Remove(PointId p, HalfTangentId half) {
  Corner& corner = corners_[Index(p)];
  certificates_.Certify(half, 0, half);
  certificates_.Certify(half, 1, half);
  // All are removed from the corners of hulls that are joined.
  if (hulls_.point(p).corner && hulls_.hull(hulls_.ClusterOf(p)).is_new) return;
  std::erase(corner.half_tangents, half);
  if (IsActive(half)) {
    std::erase(corner.active_bitangents, half);
    marks_.MarkStale(p);
  }
  if (!certificates_.HasDeferred(half)) return;
  for (const HalfTangentId other : corner.half_tangents) {
    for (const std::size_t which : {0U, 1U}) {
      if (certificates_.partner(other, which) != half) continue;
      if (marks_.IsStale(p)) {
        certificates_.Certify(other, which, other);
      } else {
        CertifyWithGap(other, which);
      }
    }
  }
}

void CornerOrder::RemoveAll(PointId p) {
  corners_[Index(p)].half_tangents.clear();
  corners_[Index(p)].active_bitangents.clear();
}

// Of the two new half tangents, one that is in a visual gap bounds it from here on, and so becomes
// active; the active bitangents between the two become inactive.
void CornerOrder::Occlude(PointId p, HalfTangentId from, HalfTangentId to) {
  if (marks_.IsStale(p)) return;
  const std::vector<HalfTangentId>& active = corner(p).active_bitangents;
  const std::size_t begin = from == kHullEdge ? 0 : ActiveBefore(from);
  const std::size_t end = to == kHullEdge ? active.size() : ActiveBefore(to);
  const bool starts = from != kHullEdge && IsVisualGap(p, begin);
  const bool ends = to != kHullEdge && IsVisualGap(p, end);
  const HalfTangentId first = starts ? from : ActiveOrEdge(p, begin - 1);
  const HalfTangentId last = ends ? to : ActiveOrEdge(p, end);
  const std::vector<HalfTangentId> occluded(active.begin() + static_cast<std::ptrdiff_t>(begin),
                                            active.begin() + static_cast<std::ptrdiff_t>(end));
  std::array<HalfTangentId, 2> bounds{};
  std::size_t count = 0;
  if (starts) bounds[count++] = from;
  if (ends) bounds[count++] = to;
  ReplaceActive(p, begin, end, std::span(bounds).first(count));

  if (!occluded.empty()) certificates_.Certify(occluded.front(), 0, first);
  for (const HalfTangentId half : occluded) certificates_.Certify(half, 1, last);
  for (const auto& [half, is_active] : {std::pair(from, starts), std::pair(to, ends)}) {
    if (half == kHullEdge || is_active) continue;
    certificates_.Certify(half, 0, first);
    certificates_.Certify(half, 1, last);
  }
  for (std::size_t i = begin; i <= begin + 3; ++i) CertifyActive(p, i - 1);
}

void CornerOrder::ReplaceActive(PointId p, std::size_t begin, std::size_t end,
                                std::span<const HalfTangentId> inserted) {
  std::vector<HalfTangentId>& active = corners_[Index(p)].active_bitangents;
  const auto from = active.begin() + static_cast<std::ptrdiff_t>(begin);
  const auto to = active.begin() + static_cast<std::ptrdiff_t>(end);
  for (auto at = from; at != to; ++at) active_[Index(*at)] = false;
  for (const HalfTangentId half : inserted) active_[Index(half)] = true;
  active.insert(active.erase(from, to), inserted.begin(), inserted.end());
}

void CornerOrder::CertifyActive(PointId p, std::size_t index) {
  const HalfTangentId half = ActiveOrEdge(p, index);
  if (half == kHullEdge) return;
  const bool last = ActiveOrEdge(p, index + 1) == kHullEdge;
  certificates_.Certify(half, 0, ActiveOrEdge(p, index - 1));
  certificates_.Certify(half, 1, last ? kHullEdge : half);  // else the next one has the certificate
}

// It may have crossed an edge of the hull together with the one that it deferred to.
void CornerOrder::CertifyWithGap(HalfTangentId half, std::size_t which) {
  const PointId p = tangents_.Own(half);
  if (tangents_.StepAt(half) != 0) marks_.MarkDisplaced(p);
  const std::size_t gap = ActiveBefore(half);
  certificates_.Certify(half, which, ActiveOrEdge(p, which == 0 ? gap - 1 : gap));
}

void CornerOrder::CertifyAgain(HalfTangentId half) {
  CertifyOnceMore(half, 0);
  CertifyOnceMore(half, 1);
  if (!certificates_.HasDeferred(half)) return;
  for (const HalfTangentId other : corner(tangents_.Own(half)).half_tangents) {
    for (const std::size_t which : {0U, 1U}) {
      if (other != half && certificates_.partner(other, which) == half) {
        CertifyOnceMore(other, which);
      }
    }
  }
}

// With the same partner. Where the two are out of order, they came in line at this very depth.
void CornerOrder::CertifyOnceMore(HalfTangentId half, std::size_t which) {
  const HalfTangentId partner = certificates_.partner(half, which);
  certificates_.Certify(half, which, partner);
  if (certificates_.Holds(half, which)) return;
  for (const PointId p : {tangents_.Own(half), tangents_.Other(half), tangents_.Other(partner)}) {
    marks_.MarkStale(p);
  }
}

void CornerOrder::Rebuild(PointId p) {
  Corner& corner = corners_[Index(p)];
  std::vector<HalfTangentId>& halves = corner.half_tangents;
  corner.active_bitangents.clear();
  // Hulls that occlude the first edge and do not end at a tangent here occlude all lines.
  const auto ends = std::count_if(halves.begin(), halves.end(),
                                  [](HalfTangentId h) { return !TangentTable::Starts(h); });
  if (corner.depth > ends) {
    for (const HalfTangentId half : halves) {
      active_[Index(half)] = false;
      certificates_.Certify(half, 0, kHullEdge);
      certificates_.Certify(half, 1, kHullEdge);
    }
    return;
  }
  Sort(p);
  FindActive(p);
  HalfTangentId before = kHullEdge;
  for (const HalfTangentId half : halves) {
    certificates_.Certify(half, 0, before);
    if (IsActive(half)) before = half;
  }
  HalfTangentId after = kHullEdge;
  for (std::size_t i = halves.size(); i-- > 0;) {
    const HalfTangentId half = halves[i];
    const bool shared = IsActive(half) && after != kHullEdge;  // the one after has the certificate
    certificates_.Certify(half, 1, shared ? half : after);
    if (IsActive(half)) after = half;
  }
}

// From half tangents in order, by the depths between them.
void CornerOrder::FindActive(PointId p) {
  Corner& corner = corners_[Index(p)];
  int depth = corner.depth;
  HalfTangentId before = kHullEdge;
  for (const HalfTangentId half : corner.half_tangents) {
    if (depth == 0) NoteVisualGap(p, before, half);
    Check(depth >= 0, "a hull occludes a line once at most");
    const int after = depth + (TangentTable::Starts(half) ? 1 : -1);
    active_[Index(half)] = depth == 0 || after == 0;
    if (IsActive(half)) corner.active_bitangents.push_back(half);
    depth = after;
    before = half;
  }
  if (depth == 0) NoteVisualGap(p, before, kHullEdge);
  Check(depth >= 0, "a hull occludes a line once at most");
}

void CornerOrder::NoteVisualGap(PointId p, HalfTangentId before, HalfTangentId after) {
  Corner& corner = corners_[Index(p)];
  corner.on_horizon = corner.on_horizon || tangents_.HasWidth(p, before, after);
}

// By floating point, and where that is not sure by Before(): each two of a corner's directions are
// less than half a turn apart, so the order is that of cross products.
std::span<const CornerOrder::Aimed> CornerOrder::Sort(PointId p) {
  std::vector<HalfTangentId>& halves = corners_[Index(p)].half_tangents;
  aimed_.clear();
  for (const HalfTangentId half : halves) {
    Aim aim = AimAt(hulls_.point(p).path, hulls_.point(tangents_.Other(half)).path, hulls_.now());
    if (!TangentTable::Ahead(half)) aim = {-aim.x, -aim.y, aim.error};
    aimed_.emplace_back(aim, half);
  }
  std::sort(aimed_.begin(), aimed_.end(), [this](const Aimed& a, const Aimed& b) {
    const int turn = FilteredCrossSign(a.first, b.first);
    return turn != 0 ? turn > 0 : tangents_.Before(a.second, b.second);
  });
  for (std::size_t i = 0; i < halves.size(); ++i) halves[i] = aimed_[i].second;
  return aimed_;
}

void CornerOrder::CheckCorner(PointId p) const {
  std::vector<HalfTangentId> halves = corner(p).half_tangents;
  std::sort(halves.begin(), halves.end(),
            [this](HalfTangentId a, HalfTangentId b) { return tangents_.Before(a, b); });
  int depth = corner(p).depth;
  std::size_t active_count = 0;
  for (const HalfTangentId half : halves) {
    Check(tangents_.Own(half) == p, "tangents are at their corners");
    const int after = depth + (TangentTable::Starts(half) ? 1 : -1);
    const bool active = depth == 0 || after == 0;
    Check(after >= 0, "a hull occludes a line once at most");
    Check(IsActive(half) == active, "tangents beside visual lines are active, and no others");
    Check(ActiveOrEdge(p, active_count) == half || !active, "the active ones are in order");
    if (active) ++active_count;
    depth = after;
  }
  Check(active_count == corner(p).active_bitangents.size(), "no others are listed as active");
  Check(depth == corner(hulls_.point(p).next).depth, "depths go on from corner to corner");
  for (const HalfTangentId half : halves) {
    for (const std::size_t which : {0U, 1U}) CheckPartners(half, which);
  }
}

void CornerOrder::CheckListed(HalfTangentId half) const {
  const std::vector<HalfTangentId>& halves = corner(tangents_.Own(half)).half_tangents;
  Check(std::count(halves.begin(), halves.end(), half) == 1, "corners know their tangents");
}

// From partner to partner to the border of the gap.
void CornerOrder::CheckPartners(HalfTangentId half, std::size_t which) const {
  const PointId p = tangents_.Own(half);
  if (IsActive(half)) {
    const auto& active = corner(p).active_bitangents;
    const auto at =
        static_cast<std::size_t>(std::find(active.begin(), active.end(), half) - active.begin());
    const HalfTangentId near = ActiveOrEdge(p, which == 0 ? at - 1 : at + 1);
    Check(certificates_.partner(half, which) == (which == 1 && near != kHullEdge ? half : near),
          "active bitangents are certified with their neighbours");
    return;
  }
  const std::size_t gap = ActiveBefore(half);
  const HalfTangentId border = ActiveOrEdge(p, which == 0 ? gap - 1 : gap);
  HalfTangentId at = half;
  while (at != kHullEdge && (at == half || !IsActive(at))) {
    const HalfTangentId next = certificates_.partner(at, which);
    Check(next != at && (next == kHullEdge || tangents_.Own(next) == p),
          "the partner of an inactive tangent is another one at its corner");
    Check(certificates_.Holds(at, which), "a partner is nearer to the border of the gap");
    at = next;
  }
  Check(at == border, "partners lead to the border of the gap");
}

}  // namespace farhorizon::kinetic
