// What is seen from a corner: the order of its tangents, their activity and certificates (sections 3.2.1,
// 3.2.3 and 3.2.5).
#include <algorithm>

#include "core/horizon/kinetic/scene.h"

namespace farhorizon::kinetic {

// The order of two tangents at one corner just after the moment.
bool Scene::Before(SideId a, SideId b) const {
  const int sense = Ahead(a) == Ahead(b) ? 1 : -1;
  const int turn = sense * Orient(Own(a), Other(a), Other(b));
  if (turn != 0) return turn > 0;
  return Starts(a) != Starts(b) ? Starts(a) : a < b;
}

// How many of the corner's active tangents are before this one.
std::size_t Scene::LitIndex(PointId p, SideId side) const {
  const std::vector<SideId>& lit = point(p).lit;
  const auto at = std::partition_point(lit.begin(), lit.end(),
                                       [&](SideId active) { return Before(active, side); });
  return static_cast<std::size_t>(at - lit.begin());
}

bool Scene::FreeAt(PointId p, std::size_t gap) const {
  return (point(p).depth == 0) == (gap % 2 == 0);
}

SideId Scene::LitOr(PointId p, std::size_t index) const {
  const std::vector<SideId>& lit = point(p).lit;
  return index < lit.size() ? lit[index] : -1;
}

bool Scene::HasWidth(PointId p, SideId before, SideId after) const {
  if (before < 0 && after < 0) return true;
  const auto sense = [](SideId side) { return Ahead(side) ? 1 : -1; };
  if (before < 0) return sense(after) * Orient(point(p).prev, p, Other(after)) > 0;
  if (after < 0) return sense(before) * Orient(p, Other(before), point(p).next) > 0;
  return sense(before) * sense(after) * Orient(p, Other(before), Other(after)) > 0;
}

// Hides all lines between two new tangents at the corner, or the hull's edges (-1). The depth is still
// that of before.
void Scene::Shade(PointId p, SideId from, SideId to) {
  if (point(p).touched) return;
  std::vector<SideId>& lit = points_[Index(p)].lit;
  const std::size_t begin = from < 0 ? 0 : LitIndex(p, from);
  const std::size_t end = to < 0 ? lit.size() : LitIndex(p, to);
  const bool starts = from >= 0 && FreeAt(p, begin);
  const bool ends = to >= 0 && FreeAt(p, end);
  const SideId first = starts ? from : LitOr(p, begin - 1);
  const SideId last = ends ? to : LitOr(p, end);
  std::vector<SideId> hidden(lit.begin() + static_cast<std::ptrdiff_t>(begin),
                             lit.begin() + static_cast<std::ptrdiff_t>(end));
  auto at = lit.erase(lit.begin() + static_cast<std::ptrdiff_t>(begin),
                      lit.begin() + static_cast<std::ptrdiff_t>(end));
  if (ends) at = lit.insert(at, to);
  if (starts) lit.insert(at, from);
  if (from >= 0) SideOf(from).active = starts;
  if (to >= 0) SideOf(to).active = ends;
  for (const SideId side : hidden) SideOf(side).active = false;

  if (!hidden.empty()) Certify(hidden.front(), 0, first);
  for (const SideId side : hidden) Certify(side, 1, last);
  for (const auto& [side, is_active] : {std::pair(from, starts), std::pair(to, ends)}) {
    if (side < 0 || is_active) continue;
    Certify(side, 0, first);
    Certify(side, 1, last);
  }
  for (std::size_t i = begin; i <= begin + 3; ++i) Relink(p, i - 1);
}

// By doubles, and where they are not sure by Before(): every two of a corner's tangents are less than half
// a turn apart.
void Scene::SortSides(PointId p) {
  std::vector<SideId>& sides = points_[Index(p)].sides;
  aimed_.clear();
  for (const SideId side : sides) {
    Aim aim = AimAt(point(p).path, point(Other(side)).path, now_);
    if (!Ahead(side)) aim = {-aim.x, -aim.y, aim.error};
    aimed_.emplace_back(aim, side);
  }
  std::sort(aimed_.begin(), aimed_.end(), [this](const auto& a, const auto& b) {
    const int turn = TurnOf(a.first, b.first);
    return turn != 0 ? turn > 0 : Before(a.second, b.second);
  });
  for (std::size_t i = 0; i < sides.size(); ++i) sides[i] = aimed_[i].second;
}

// Activities, certificates and what is seen at one corner, from its depth and its tangents alone.
void Scene::Rebuild(PointId p) {
  Point& corner = points_[Index(p)];
  std::vector<SideId>& sides = corner.sides;
  corner.lit.clear();
  // Hulls that hide the first edge and end at no tangent here hide all.
  const auto ends = std::count_if(sides.begin(), sides.end(), [](SideId s) { return !Starts(s); });
  if (corner.depth > ends) {
    for (const SideId side : sides) {
      SideOf(side).active = false;
      Certify(side, 0, -1);
      Certify(side, 1, -1);
    }
    return;
  }
  SortSides(p);
  LightUp(p);
  SideId before = -1;
  for (const SideId side : sides) {
    Certify(side, 0, before);
    if (Active(side)) before = side;
  }
  SideId after = -1;
  for (std::size_t i = sides.size(); i-- > 0;) {
    const SideId side = sides[i];
    const bool shared = Active(side) && after >= 0;  // the one after has the certificate
    Certify(side, 1, shared ? side : after);
    if (Active(side)) after = side;
  }
}

// Finds the active ones among tangents in order.
void Scene::LightUp(PointId p) {
  Point& corner = points_[Index(p)];
  const std::vector<SideId>& sides = corner.sides;
  int depth = corner.depth;
  for (std::size_t i = 0; i <= sides.size(); ++i) {
    if (depth == 0 && !corner.seen) {
      corner.seen = HasWidth(p, i == 0 ? -1 : sides[i - 1], i == sides.size() ? -1 : sides[i]);
    }
    Check(depth >= 0, "a hull hides lines once at most");
    if (i == sides.size()) break;
    const int after = depth + (Starts(sides[i]) ? 1 : -1);
    SideOf(sides[i]).active = depth == 0 || after == 0;
    if (Active(sides[i])) corner.lit.push_back(sides[i]);
    depth = after;
  }
}

// Takes a tangent from its corner; what hangs on it hangs on the border of its gap then.
void Scene::TakeOff(PointId p, SideId s) {
  Point& corner = points_[Index(p)];
  Tangent::Side& gone = SideOf(s);
  Certify(s, 0, s);
  Certify(s, 1, s);
  if (corner.corner && cluster(Find(corner.cluster)).fresh) return;  // Join() takes off all
  std::erase(corner.sides, s);
  if (gone.active) {
    std::erase(corner.lit, s);
    Touch(p);
  }
  if (gone.hanging[0] == 0 && gone.hanging[1] == 0) return;
  for (const SideId side : corner.sides) {
    for (const std::size_t which : {0U, 1U}) {
      if (SideOf(side).with[which] != s) continue;
      if (corner.touched) {
        Certify(side, which, side);
      } else {
        Rehang(side, which);
      }
    }
  }
}

// Certifies an inactive tangent with the border of its gap. It may go over the hull's edge together with
// what it hung on.
void Scene::Rehang(SideId side, std::size_t which) {
  const PointId p = Own(side);
  if (StepAt(side) != 0) Shake(p);
  const std::size_t gap = LitIndex(p, side);
  Certify(side, which, LitOr(p, which == 0 ? gap - 1 : gap));
}

// The order that a certificate promises, just after the moment; between tangents only.
bool Scene::Holds(SideId side, std::size_t which) const {
  const SideId with = tangent(side / 2).sides[side % 2 ? 1 : 0].with[which];
  return with < 0 || with == side || (which == 0 ? Before(with, side) : Before(side, with));
}

// For a tangent whose other end has gone to another corner: all its certificates with other corners. Those
// that do not hold any more came in line at this very moment.
void Scene::Renew(SideId s) {
  const auto renew = [this](SideId side, std::size_t which) {
    const SideId with = SideOf(side).with[which];
    Certify(side, which, with);
    if (Holds(side, which)) return;
    for (const PointId p : {Own(side), Other(side), Other(with)}) Touch(p);
  };
  renew(s, 0);
  renew(s, 1);
  if (SideOf(s).hanging[0] == 0 && SideOf(s).hanging[1] == 0) return;
  for (const SideId side : point(Own(s)).sides) {
    for (const std::size_t which : {0U, 1U}) {
      if (side != s && SideOf(side).with[which] == s) renew(side, which);
    }
  }
}

// The certificates of an active tangent; none where there is none of that index.
void Scene::Relink(PointId p, std::size_t index) {
  const SideId side = LitOr(p, index);
  if (side < 0) return;
  Certify(side, 0, LitOr(p, index - 1));
  Certify(side, 1, LitOr(p, index + 1) < 0 ? -1 : side);
}

// The certificate of a tangent with what is next before (0) or after it (1): another tangent, the edge
// of the hull (-1), or none (itself).
void Scene::Certify(SideId s, std::size_t which, SideId with) {
  Tangent::Side& side = SideOf(s);
  const SideId old = std::exchange(side.with[which], with);
  if (old != with) {
    if (old >= 0 && old != s) --SideOf(old).hanging[which];
    if (with >= 0 && with != s) ++SideOf(with).hanging[which];
  }
  const SideId id = 2 * s + static_cast<SideId>(which);
  Tangent::Key key;
  if (with != s) {
    const PointId p = Own(s);
    const PointId q = Other(s);
    const bool scene = with >= 0;
    key.sign = (Ahead(s) ? 1 : -1) * (!scene || Ahead(with) ? 1 : -1);
    if (which == 0) {
      key.points = scene ? std::array{p, Other(with), q} : std::array{point(p).prev, p, q};
    } else {
      key.points = {p, q, scene ? Other(with) : point(p).next};
    }
  }
  if (key == side.keys[which]) return;
  side.keys[which] = key;
  if (key.sign == 0) {
    Cancel(side.certificates[which]);
    return;
  }
  const auto [a, b, c] = key.points;
  Schedule(
      Promise::kTangent, id,
      TurnAfter(point(a).path, point(b).path, point(c).path, key.sign, now_, FirstEnd(a, b, c)));
}

}  // namespace farhorizon::kinetic
