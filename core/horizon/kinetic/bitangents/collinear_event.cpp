// What changes at one corner, "#" for occluded lines, from the order before to the one after:
//
//      close:     ####end   start####    ->    ####start#end####      both become inactive
//      open:      ####start#end####      ->    ####end   start####    both become active
//      replace:       a#####b#####       ->        b#####a#####       b is active in place of a
//
// and the mirror image of the last, of two ends. Whether a corner is as expected is found from the
// predicates just after the event, before anything is changed at any of the three.
#include "core/horizon/kinetic/bitangents/collinear_event.h"

#include <algorithm>

namespace farhorizon::kinetic {

bool CollinearEvents::AreOne() const {
  const auto sorted = [](std::array<PointId, 3> points) {
    std::sort(points.begin(), points.end());
    return points;
  };
  return std::all_of(pairs_.begin(), pairs_.end(), [&](const CollinearPair& pair) {
    return sorted(pair.points) == sorted(pairs_.front().points);
  });
}

void CollinearEvents::MarkDisplaced() {
  for (const CollinearPair& pair : pairs_) {
    for (const TangentId t : {TangentOf(pair.half), TangentOf(pair.partner)}) {
      if (tangents_.contacts(t)[0] < 0 || tangents_.Supports(t)) continue;
      for (const PointId p : tangents_.contacts(t)) marks_.MarkDisplaced(p);
    }
  }
}

void CollinearEvents::Exchange() {
  for (const CollinearPair& pair : pairs_) {
    const bool any_active = order_.IsActive(pair.half) || order_.IsActive(pair.partner);
    if (!IsPending(pair) || !any_active || ExchangeThree(pair)) continue;
    MarkStale(pair);
  }
  // What is left are pairs of inactive ones, one of which deferred to the other.
  for (const CollinearPair& pair : pairs_) {
    if (!IsPending(pair)) continue;
    const PointId p = tangents_.Own(pair.half);
    if (order_.IsActive(pair.half) || order_.IsVisualGap(p, order_.ActiveBefore(pair.half))) {
      MarkStale(pair);
    } else {
      order_.CertifyWithGap(pair.half, pair.which);
    }
  }
  pairs_.clear();
}

void CollinearEvents::MarkStale() {
  for (const CollinearPair& pair : pairs_) MarkStale(pair);
  pairs_.clear();
}

void CollinearEvents::MarkStale(const CollinearPair& pair) {
  for (const PointId p : pair.points) marks_.MarkStale(p);
}

// Whether nothing has replaced the failed certificate.
bool CollinearEvents::IsPending(const CollinearPair& pair) const {
  return !marks_.IsStale(tangents_.Own(pair.half)) &&
         certificates_.partner(pair.half, pair.which) == pair.partner &&
         !certificates_.IsCertified(pair.half, pair.which);
}

// False, and nothing is done, where a corner is not as expected.
bool CollinearEvents::ExchangeThree(const CollinearPair& pair) {
  const std::optional<std::array<Meeting, 3>> meetings = MeetingsOf(pair);
  if (!meetings) return false;
  std::array<std::size_t, 3> places{};
  for (std::size_t i = 0; i < 3; ++i) {
    const std::optional<std::size_t> place = PlaceOf((*meetings)[i]);
    if (!place) return false;
    places[i] = *place;
  }
  for (std::size_t i = 0; i < 3; ++i) {
    const Meeting& meeting = (*meetings)[i];
    const bool first = order_.IsActive(meeting.first);
    const bool second = order_.IsActive(meeting.second);
    if (first && second) {
      CloseGap(meeting.corner, places[i]);
    } else if (first || second) {
      Replace(meeting, places[i]);
    } else {
      OpenGap(meeting, places[i]);
    }
  }
  return true;
}

// The pair and what meets at the two other ends; nullopt where the third tangent is none, or a
// tangent is active at one end only.
std::optional<std::array<CollinearEvents::Meeting, 3>> CollinearEvents::MeetingsOf(
    const CollinearPair& pair) const {
  const HalfTangentId s = pair.half;
  const HalfTangentId t = pair.partner;
  const PointId u = tangents_.Other(s);
  const PointId w = tangents_.Other(t);
  if (u < 0 || w < 0 || !hulls_.point(u).corner || !hulls_.point(w).corner) return std::nullopt;
  const ClusterId c = hulls_.ClusterOf(u);
  const ClusterId d = hulls_.ClusterOf(w);
  if (c == d) return std::nullopt;
  TangentId third = tangents_.First(c, d);
  const TangentId end = third + 4;
  const auto joins_u_and_w = [&](TangentId of) {
    const auto [p, q] = tangents_.contacts(of);
    return (p == u && q == w) || (p == w && q == u);
  };
  while (third < end && !(joins_u_and_w(third) && tangents_.Supports(third))) ++third;
  if (third == end) return std::nullopt;
  const HalfTangentId at_u = tangents_.Own(2 * third) == u ? 2 * third : 2 * third + 1;
  for (const HalfTangentId half : {s, t, at_u}) {
    if (order_.IsActive(half) != order_.IsActive(Opposite(half))) return std::nullopt;
  }
  return std::array{Meeting{tangents_.Own(s), s, t}, Meeting{u, Opposite(s), at_u},
                    Meeting{w, Opposite(t), Opposite(at_u)}};
}

// Where the exchange takes place among the active bitangents; nullopt where the corner is not as
// expected.
std::optional<std::size_t> CollinearEvents::PlaceOf(const Meeting& meeting) const {
  const PointId p = meeting.corner;
  if (!hulls_.point(p).corner || marks_.IsStale(p)) return std::nullopt;
  const bool first = order_.IsActive(meeting.first);
  const bool second = order_.IsActive(meeting.second);
  if (first && second) return PlaceToClose(meeting);
  return first || second ? PlaceToReplace(meeting) : PlaceToOpen(meeting);
}

// The gap that both are in.
std::optional<std::size_t> CollinearEvents::PlaceToOpen(const Meeting& meeting) const {
  const bool starts = TangentTable::Starts(meeting.first);
  const HalfTangentId start = starts ? meeting.first : meeting.second;
  const HalfTangentId end = starts ? meeting.second : meeting.first;
  const std::size_t gap = order_.ActiveBefore(end);
  if (TangentTable::Starts(end) || !TangentTable::Starts(start) || !tangents_.Before(end, start) ||
      order_.ActiveBefore(start) != gap || order_.IsVisualGap(meeting.corner, gap)) {
    return std::nullopt;
  }
  return gap;
}

// The index of the end, after which the start comes.
std::optional<std::size_t> CollinearEvents::PlaceToClose(const Meeting& meeting) const {
  const PointId p = meeting.corner;
  const bool starts = TangentTable::Starts(meeting.first);
  const std::size_t index = ActiveIndex(p, meeting.first);
  const std::size_t at = starts ? index - 1 : index;
  const HalfTangentId end = order_.ActiveOrEdge(p, at);
  const HalfTangentId start = order_.ActiveOrEdge(p, at + 1);
  if (end == kHullEdge || TangentTable::Starts(end) || start == kHullEdge) return std::nullopt;
  if ((starts ? end : start) != meeting.second || !tangents_.Before(start, end))
    return std::nullopt;
  return at;
}

// The index of the active one, which the inactive one has passed, and no other.
std::optional<std::size_t> CollinearEvents::PlaceToReplace(const Meeting& meeting) const {
  const PointId p = meeting.corner;
  const bool first = order_.IsActive(meeting.first);
  const HalfTangentId active = first ? meeting.first : meeting.second;
  const HalfTangentId inactive = first ? meeting.second : meeting.first;
  const bool starts = TangentTable::Starts(active);
  if (TangentTable::Starts(inactive) != starts ||
      certificates_.deferred(inactive, starts ? 1 : 0) != 0) {
    return std::nullopt;
  }
  const auto ordered = [&](HalfTangentId a, HalfTangentId b) {
    return starts ? tangents_.Before(a, b) : tangents_.Before(b, a);
  };
  const std::size_t index = ActiveIndex(p, active);
  const HalfTangentId beyond = order_.ActiveOrEdge(p, starts ? index - 1 : index + 1);
  if (!ordered(inactive, active) || (beyond != kHullEdge && !ordered(beyond, inactive))) {
    return std::nullopt;
  }
  return index;
}

std::size_t CollinearEvents::ActiveIndex(PointId p, HalfTangentId active) const {
  const std::vector<HalfTangentId>& all = order_.corner(p).active_bitangents;
  return static_cast<std::size_t>(std::find(all.begin(), all.end(), active) - all.begin());
}

void CollinearEvents::CloseGap(PointId p, std::size_t index) {
  const HalfTangentId end = order_.ActiveOrEdge(p, index);
  const HalfTangentId start = order_.ActiveOrEdge(p, index + 1);
  order_.ReplaceActive(p, index, index + 2, {});
  for (const HalfTangentId half : {end, start}) {
    certificates_.Certify(half, 0, order_.ActiveOrEdge(p, index - 1));
    certificates_.Certify(half, 1, order_.ActiveOrEdge(p, index));
  }
  order_.CertifyActive(p, index - 1);
  order_.CertifyActive(p, index);
}

// The one that loses its place defers to its successor; all that deferred to it still do.
void CollinearEvents::Replace(const Meeting& meeting, std::size_t index) {
  const PointId p = meeting.corner;
  const bool first = order_.IsActive(meeting.first);
  const HalfTangentId old = first ? meeting.first : meeting.second;
  const std::array next{first ? meeting.second : meeting.first};
  order_.ReplaceActive(p, index, index + 1, next);
  order_.CertifyActive(p, index - 1);
  order_.CertifyActive(p, index);
  order_.CertifyActive(p, index + 1);
  const bool starts = TangentTable::Starts(old);
  certificates_.Certify(old, starts ? 0 : 1, next[0]);
  certificates_.Certify(old, starts ? 1 : 0,
                        order_.ActiveOrEdge(p, starts ? index + 1 : index - 1));
}

// The occluded gap is split. Each half tangent in it has the new border on its side as its partner
// from here on (lemma 3.13 of the thesis, last case).
void CollinearEvents::OpenGap(const Meeting& meeting, std::size_t index) {
  const PointId p = meeting.corner;
  const bool starts = TangentTable::Starts(meeting.first);
  const HalfTangentId end = starts ? meeting.second : meeting.first;
  const HalfTangentId start = starts ? meeting.first : meeting.second;
  const HalfTangentId before = order_.ActiveOrEdge(p, index - 1);
  const HalfTangentId after = order_.ActiveOrEdge(p, index);
  order_.ReplaceActive(p, index, index, std::array{end, start});
  order_.NoteVisualGap(p, end, start);
  for (const HalfTangentId half : order_.corner(p).half_tangents) {
    if (order_.IsActive(half)) continue;
    if (tangents_.Before(half, end)) {
      if (before == kHullEdge || tangents_.Before(before, half))
        certificates_.Certify(half, 1, end);
    } else if (tangents_.Before(start, half)) {
      if (after == kHullEdge || tangents_.Before(half, after))
        certificates_.Certify(half, 0, start);
    } else {
      marks_.MarkStale(p);
    }
  }
  for (std::size_t i = index; i <= index + 3; ++i) order_.CertifyActive(p, i - 1);
}

}  // namespace farhorizon::kinetic
