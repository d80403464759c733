// Three corners in line and nothing else: algorithm 3.2 in place. At each of the three corners two of the
// three tangents change places, and all three change their activity: two active ones close the visual
// lines between them, an active one gives its place to another, or two inactive ones open a gap (figure 3.12).
#include <algorithm>
#include <utility>

#include "core/horizon/kinetic/scene.h"

namespace farhorizon::kinetic {

// Two inactive tangents: the gap that they stand in and open.
std::optional<std::size_t> Scene::PlaceOfGap(const Pair& pair) const {
  const auto& [p, a, b] = pair;
  const SideId end = Starts(a) ? b : a;
  const SideId start = Starts(a) ? a : b;
  const std::size_t gap = LitIndex(p, end);
  if (Starts(end) || !Starts(start) || !Before(end, start) || LitIndex(p, start) != gap ||
      FreeAt(p, gap)) {
    return std::nullopt;
  }
  return gap;
}

// Two active ones, next to each other: the former's.
std::optional<std::size_t> Scene::PlaceOfCollapse(PointId p, SideId active, SideId other) const {
  const std::vector<SideId>& lit = point(p).lit;
  const auto index =
      static_cast<std::size_t>(std::find(lit.begin(), lit.end(), active) - lit.begin());
  const std::size_t end = Starts(active) ? index - 1 : index;
  const SideId start = LitOr(p, end + 1);
  if (Starts(lit[end < lit.size() ? end : index]) || start < 0) return std::nullopt;
  if ((Starts(active) ? lit[end] : start) != other || !Before(start, lit[end])) {
    return std::nullopt;
  }
  return end;
}

// An active one, that an inactive one has gone past.
std::optional<std::size_t> Scene::PlaceOfExchange(PointId p, SideId active, SideId other) const {
  const std::vector<SideId>& lit = point(p).lit;
  const auto index =
      static_cast<std::size_t>(std::find(lit.begin(), lit.end(), active) - lit.begin());
  const bool starts = Starts(active);
  const SideId beyond = LitOr(p, starts ? index - 1 : index + 1);
  if (Starts(other) != starts ||
      tangent(other / 2).sides[other % 2 ? 1 : 0].hanging[starts ? 1 : 0] != 0) {
    return std::nullopt;
  }
  const auto ordered = [&](SideId x, SideId y) { return starts ? Before(x, y) : Before(y, x); };
  if (!ordered(other, active) || (beyond >= 0 && !ordered(beyond, other))) return std::nullopt;
  return index;
}

// The index in lit where the pair's exchange takes place; nullopt where the corner is not as expected.
std::optional<std::size_t> Scene::PlaceOf(const Pair& pair) const {
  const auto& [p, a, b] = pair;
  if (!point(p).corner || point(p).touched) return std::nullopt;
  if (!Active(a) && !Active(b)) return PlaceOfGap(pair);
  const SideId active = Active(a) ? a : b;
  const SideId other = Active(a) ? b : a;
  return Active(other) ? PlaceOfCollapse(p, active, other) : PlaceOfExchange(p, active, other);
}

// Two active tangents have closed the visual lines between them.
void Scene::Collapse(const Pair& pair, std::size_t index) {
  const PointId p = pair.at;
  std::vector<SideId>& lit = points_[Index(p)].lit;
  const SideId end = lit[index];
  const SideId start = lit[index + 1];
  const auto at = lit.begin() + static_cast<std::ptrdiff_t>(index);
  lit.erase(at, at + 2);
  const SideId before = LitOr(p, index - 1);
  const SideId after = LitOr(p, index);
  for (const SideId side : {end, start}) {
    SideOf(side).active = false;
    Certify(side, 0, before);
    Certify(side, 1, after);
  }
  Relink(p, index - 1);
  Relink(p, index);
}

// An inactive tangent has gone past an active one, and takes its place.
void Scene::Exchange(const Pair& pair, std::size_t index) {
  const PointId p = pair.at;
  const SideId old = Active(pair.first) ? pair.first : pair.second;
  const SideId next = Active(pair.first) ? pair.second : pair.first;
  points_[Index(p)].lit[index] = next;
  SideOf(old).active = false;
  SideOf(next).active = true;
  Relink(p, index - 1);
  Relink(p, index);
  Relink(p, index + 1);
  const bool starts = Starts(old);
  Certify(old, starts ? 0 : 1, next);
  Certify(old, starts ? 1 : 0, LitOr(p, starts ? index + 1 : index - 1));
}

// Two inactive tangents have come apart, with visual lines between them (lemma 3.13, last case).
void Scene::Part(const Pair& pair, std::size_t index) {
  const PointId p = pair.at;
  Point& corner = points_[Index(p)];
  const SideId end = Starts(pair.first) ? pair.second : pair.first;
  const SideId start = Starts(pair.first) ? pair.first : pair.second;
  const SideId before = LitOr(p, index - 1);
  const SideId after = LitOr(p, index);
  corner.lit.insert(corner.lit.begin() + static_cast<std::ptrdiff_t>(index), {end, start});
  SideOf(end).active = SideOf(start).active = true;
  corner.seen = corner.seen || HasWidth(p, end, start);
  for (const SideId side : corner.sides) {
    if (Active(side)) continue;
    if (Before(side, end)) {
      if (before < 0 || Before(before, side)) Certify(side, 1, end);
    } else if (Before(start, side)) {
      if (after < 0 || Before(side, after)) Certify(side, 0, start);
    } else {
      Touch(p);
    }
  }
  for (std::size_t i = index; i <= index + 3; ++i) Relink(p, i - 1);
}

// False, and nothing done, where the three corners are not in line by themselves.
bool Scene::PassThree(const Passed& passed) {
  const SideId s = passed.side;
  const SideId t = passed.with;
  const PointId u = Other(s);
  const PointId w = Other(t);
  if (u < 0 || w < 0 || !point(u).corner || !point(w).corner) return false;
  const ClusterId c = Find(point(u).cluster);
  const ClusterId d = Find(point(w).cluster);
  if (c == d) return false;
  std::int32_t third = FirstTangent(c, d);
  const std::int32_t end = third + 4;
  const auto touches = [&](PointId p) {
    return tangent(third).touch[0] == p || tangent(third).touch[1] == p;
  };
  while (third < end && !(touches(u) && touches(w) && Stands(third))) ++third;
  if (third == end) return false;
  const SideId at_u = Own(2 * third) == u ? 2 * third : 2 * third + 1;
  const std::array<Pair, 3> pairs{Pair{Own(s), s, t}, Pair{u, s ^ 1, at_u},
                                  Pair{w, t ^ 1, at_u ^ 1}};
  for (const SideId side : {s, t, at_u}) {
    if (Active(side) != Active(side ^ 1)) return false;
  }
  std::array<std::size_t, 3> places{};
  for (std::size_t i = 0; i < 3; ++i) {
    const std::optional<std::size_t> place = PlaceOf(pairs[i]);
    if (!place) return false;
    places[i] = *place;
  }
  for (std::size_t i = 0; i < 3; ++i) {
    const int active = (Active(pairs[i].first) ? 1 : 0) + (Active(pairs[i].second) ? 1 : 0);
    if (active == 2) {
      Collapse(pairs[i], places[i]);
    } else if (active == 1) {
      Exchange(pairs[i], places[i]);
    } else {
      Part(pairs[i], places[i]);
    }
  }
  return true;
}

// Requires: nothing else happens at the moment.
void Scene::PassTangents() {
  const auto pending = [this](const Passed& passed) {
    const Tangent::Side& side = SideOf(passed.side);
    return !point(Own(passed.side)).touched && side.with[passed.which] == passed.with &&
           side.keys[passed.which].sign == 0;
  };
  for (const Passed& passed : passed_) {
    if (!pending(passed) || (!Active(passed.side) && !Active(passed.with))) continue;
    if (PassThree(passed)) continue;
    for (const PointId p : passed.points) Touch(p);
  }
  for (const Passed& passed : passed_) {
    if (!pending(passed)) continue;
    const PointId p = Own(passed.side);
    if (Active(passed.side) || FreeAt(p, LitIndex(p, passed.side))) {
      for (const PointId touched : passed.points) Touch(touched);
    } else {
      Rehang(passed.side, passed.which);
    }
  }
}

}  // namespace farhorizon::kinetic
