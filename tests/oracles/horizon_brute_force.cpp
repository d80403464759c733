// Definition D2 taken at its word. The lines that touch ab are pairs of a position t along it and a
// direction. Each other segment f blocks at t the arc of directions towards its part above p(t).
// The ends of the arcs move with t; their order can change only at roots of polynomials of degree
// at most two: where p(t) and two of them are in line, where p(t) has the height of an end of f,
// where it passes f in plan. Between two neighbouring roots the arcs leave a direction free
// everywhere or nowhere, so one sample decides. A ring of arcs that hides everything at a sample
// does so up to the nearest root of its own
// polynomials: all the cells up to there need no sample of theirs.

#include "tests/oracles/horizon_brute_force.h"

#include <algorithm>
#include <deque>
#include <map>
#include <optional>
#include <utility>

#include "core/base/result.h"
#include "tests/oracles/point_view_by_definition.h"
#include "tests/oracles/quadratic_root.h"

namespace farhorizon {
namespace {

using namespace oracle;

struct Vector64 {
  std::int64_t x;
  std::int64_t y;
};

Vector64 PlanVector(Point3i from, Point3i to) {
  return {std::int64_t{to.x} - from.x, std::int64_t{to.y} - from.y};
}

Obstacle SeenFrom(const Segment& segment, const Segment& other) {
  const bool rising = other.a.z <= other.b.z;
  const Point3i low = rising ? other.a : other.b;
  const Point3i high = rising ? other.b : other.a;
  const Vector64 d = PlanVector(segment.a, segment.b);
  const Vector64 w = PlanVector(low, high);
  const Vector64 q = PlanVector(segment.a, low);
  const Vector64 r = PlanVector(segment.a, high);
  const std::int64_t rise = std::int64_t{high.z} - low.z;
  const std::int64_t over = std::int64_t{segment.a.z} - low.z;
  const std::int64_t slope = std::int64_t{segment.b.z} - segment.a.z;
  Obstacle f;
  f.low_z = low.z;
  f.high_z = high.z;
  f.to_low = {q.x, q.y, -d.x, -d.y};
  f.to_high = {r.x, r.y, -d.x, -d.y};
  // low + w (over + t slope) / rise - (a + t d), times rise.
  f.to_slice = {rise * q.x + w.x * over, rise * q.y + w.y * over, w.x * slope - rise * d.x,
                w.y * slope - rise * d.y};
  f.parallel = d.x * w.y == d.y * w.x;
  // (low.z - c(t)) w.w + rise ((p(t) - low) . w): the height of f over p(t), times w.w.
  const Wide ww = Wide(w.x) * w.x + Wide(w.y) * w.y;
  const Wide qw = Wide(q.x) * w.x + Wide(q.y) * w.y;
  const Wide dw = Wide(d.x) * w.x + Wide(d.y) * w.y;
  f.above = {-ww * over - qw * rise, dw * rise - ww * slope, 0};
  return f;
}

class Sight {
 public:
  Sight(const Segment& segment, const std::vector<Segment>& obstacles, Ties ties)
      : segment_(segment) {
    Check(segment.a.x != segment.b.x || segment.a.y != segment.b.y, "the segment has a plan");
    problem_.z0 = segment.a.z;
    problem_.z1 = std::int64_t{segment.b.z} - segment.a.z;
    problem_.ties = ties;
    for (const Segment& other : obstacles) {
      Check(other.a.x != other.b.x || other.a.y != other.b.y, "every obstacle has a plan");
      problem_.obstacles.push_back(SeenFrom(segment, other));
    }
    for (const Obstacle& f : problem_.obstacles) {
      for (const MovingVector64& v : {f.to_low, f.to_high, f.to_slice}) {
        for (const std::int64_t x : {v.x0, v.y0, v.x1, v.y1}) Measure(x);
      }
      Measure(f.low_z);
      Measure(f.high_z);
    }
    Measure(problem_.z0);
    Measure(problem_.z1);
  }

  /// Samples until one is free or what the samples' covers hide is the whole segment.
  std::optional<OracleLineOfSight> Decide() {
    std::deque<std::pair<QuadraticNumber, QuadraticNumber>> undecided{{kZero, kOne}};
    while (!undecided.empty()) {
      const auto [low, high] = undecided.front();
      undecided.pop_front();
      const DyadicNumber t = SimplestBetween(low, high);
      const LineVerdict verdict = LookAround(problem_, t);
      if (verdict.kind == LineVerdict::Kind::kFree) return OracleLineOfSight{t, verdict.gap};
      QuadraticNumber from = QuadraticNumber::Dyadic(t.numerator, t.exponent);
      QuadraticNumber to = from;
      if (verdict.kind == LineVerdict::Kind::kOccluded) {
        std::tie(from, to) = Certified(verdict.cover, from, low, high);
      }
      if (low < from) undecided.emplace_back(low, from);
      if (to < high) undecided.emplace_back(to, high);
    }
    return std::nullopt;
  }

  /// A sample between any two neighbouring critical positions.
  bool DecideByAllCells() {
    std::vector<QuadraticNumber> critical = AllCriticalPositions();
    critical.push_back(kZero);
    critical.push_back(kOne);
    std::sort(critical.begin(), critical.end());
    for (std::size_t i = 0; i + 1 < critical.size(); ++i) {
      if (!(critical[i] < critical[i + 1])) continue;
      const LineVerdict verdict =
          LookAround(problem_, SimplestBetween(critical[i], critical[i + 1]));
      Check(verdict.kind != LineVerdict::Kind::kCritical, "every critical position is known");
      if (verdict.kind == LineVerdict::Kind::kFree) return true;
    }
    return false;
  }

 private:
  void Measure(std::int64_t x) { problem_.largest = std::max(problem_.largest, x < 0 ? -x : x); }

  /// Where p(t) has the height of an end of `f`, and, if `f` is in line with ab, where p(t) passes
  /// an end or f's height over p(t) changes its sign.
  void AppendPassing(const Obstacle& f, std::vector<Quadratic>& polynomials) const {
    polynomials.push_back({problem_.z0 - f.low_z, problem_.z1, 0});
    polynomials.push_back({problem_.z0 - f.high_z, problem_.z1, 0});
    if (!f.parallel) return;
    polynomials.push_back(f.above);
    const Vector64 d = PlanVector(segment_.a, segment_.b);
    for (const MovingVector64& v : {f.to_low, f.to_high}) {
      polynomials.push_back(
          {Wide(v.x0) * d.x + Wide(v.y0) * d.y, Wide(v.x1) * d.x + Wide(v.y1) * d.y, 0});
    }
  }

  [[nodiscard]] MovingVector ArcEnd(const CoverLink& link, bool start) const {
    const Obstacle& f = problem_.obstacles[link.obstacle];
    if (start == link.swapped) return f.to_high.Widened();
    return (link.slice ? f.to_slice : f.to_low).Widened();
  }

  /// The range around t in which `cover` hides everything: up to the nearest roots of the
  /// polynomials that keep it together.
  [[nodiscard]] std::pair<QuadraticNumber, QuadraticNumber> Certified(
      const std::vector<CoverLink>& cover, const QuadraticNumber& t, const QuadraticNumber& low,
      const QuadraticNumber& high) const {
    std::vector<Quadratic> polynomials;
    for (std::size_t i = 0; i < cover.size(); ++i) {
      AppendPassing(problem_.obstacles[cover[i].obstacle], polynomials);
      if (cover[i].over) continue;
      const CoverLink& next = cover[(i + 1) % cover.size()];
      polynomials.push_back(Cross(ArcEnd(cover[i], true), ArcEnd(cover[i], false)));
      polynomials.push_back(Cross(ArcEnd(cover[i], false), ArcEnd(next, true)));
    }
    QuadraticNumber from = low;
    QuadraticNumber to = high;
    for (const Quadratic& f : polynomials) {
      for (const QuadraticNumber& root : RootsInside(f)) {
        const int side = Compare(root, t);
        if (side <= 0 && from < root) from = root;
        if (side >= 0 && root < to) to = root;
      }
    }
    return {from, to};
  }

  [[nodiscard]] std::vector<QuadraticNumber> AllCriticalPositions() const {
    std::vector<Quadratic> polynomials;
    std::vector<MovingVector> ends;
    for (const Obstacle& f : problem_.obstacles) {
      AppendPassing(f, polynomials);
      ends.push_back(f.to_low.Widened());
      ends.push_back(f.to_high.Widened());
      if (f.low_z != f.high_z) ends.push_back(f.to_slice.Widened());
    }
    for (std::size_t i = 0; i < ends.size(); ++i) {
      for (std::size_t j = 0; j < i; ++j) polynomials.push_back(Cross(ends[i], ends[j]));
    }
    std::vector<QuadraticNumber> roots;
    for (const Quadratic& f : polynomials) {
      for (const QuadraticNumber& root : RootsInside(f)) roots.push_back(root);
    }
    return roots;
  }

  inline static const QuadraticNumber kZero = QuadraticNumber::Rational(0, 1);
  inline static const QuadraticNumber kOne = QuadraticNumber::Rational(1, 1);

  Segment segment_;
  SightProblem problem_;
};

using Sides = std::map<Edge, std::vector<VertexId>>;  // the third posts of the triangles of an edge

Sides SidesOf(const OracleMesh& mesh) {
  Sides sides;
  for (const Triangle& t : mesh.triangles) {
    for (std::size_t k = 0; k < 3; ++k) {
      sides[MakeEdge(t[k], t[(k + 1) % 3])].push_back(t[(k + 2) % 3]);
    }
  }
  return sides;
}

bool Coplanar(Point3i a, Point3i b, Point3i c, Point3i d) {
  const auto minus = [&a](Point3i p) {
    return std::array<__int128, 3>{p.x - __int128{a.x}, p.y - __int128{a.y}, p.z - __int128{a.z}};
  };
  const auto u = minus(b);
  const auto v = minus(c);
  const auto w = minus(d);
  return u[0] * (v[1] * w[2] - v[2] * w[1]) - u[1] * (v[0] * w[2] - v[2] * w[0]) +
             u[2] * (v[0] * w[1] - v[1] * w[0]) ==
         0;
}

Segment SegmentOf(const OracleMesh& mesh, Edge edge) {
  return {mesh.points[static_cast<std::size_t>(edge.a)],
          mesh.points[static_cast<std::size_t>(edge.b)]};
}

}  // namespace

OracleMesh MeshOf(const Terrain& terrain) {
  OracleMesh mesh;
  for (VertexId v = 0; v < terrain.post_count(); ++v) mesh.points.push_back(terrain.Point(v));
  mesh.triangles = terrain.Triangles();
  return mesh;
}

std::vector<Edge> EdgesOf(const OracleMesh& mesh) {
  std::vector<Edge> edges;
  for (const auto& [edge, thirds] : SidesOf(mesh)) edges.push_back(edge);
  return edges;
}

std::vector<Edge> CreasesOf(const OracleMesh& mesh) {
  const auto point = [&mesh](VertexId v) { return mesh.points[static_cast<std::size_t>(v)]; };
  std::vector<Edge> creases;
  for (const auto& [edge, thirds] : SidesOf(mesh)) {
    if (thirds.size() == 2 &&
        Coplanar(point(edge.a), point(edge.b), point(thirds[0]), point(thirds[1]))) {
      continue;
    }
    creases.push_back(edge);
  }
  return creases;
}

std::vector<Edge> HorizonByBruteForce(const OracleMesh& mesh) {
  const std::vector<Edge> edges = EdgesOf(mesh);
  std::vector<Edge> horizon;
  for (const Edge edge : CreasesOf(mesh)) {
    const Segment segment = SegmentOf(mesh, edge);
    std::vector<Segment> obstacles;
    for (const Edge other : edges) {
      const Segment f = SegmentOf(mesh, other);
      // Ground that is nowhere above the lower end is nowhere above the edge.
      if (other == edge || std::max(f.a.z, f.b.z) <= std::min(segment.a.z, segment.b.z)) continue;
      obstacles.push_back(f);
    }
    if (LineOfSightByBruteForce(segment, obstacles, Ties::kPass)) horizon.push_back(edge);
  }
  return horizon;
}

std::vector<Edge> HorizonByBruteForce(const Terrain& terrain) {
  return HorizonByBruteForce(MeshOf(terrain));
}

std::optional<OracleLineOfSight> LineOfSightByBruteForce(const Segment& segment,
                                                         const std::vector<Segment>& obstacles,
                                                         Ties ties) {
  return Sight(segment, obstacles, ties).Decide();
}

bool LineOfSightByAllCells(const Segment& segment, const std::vector<Segment>& obstacles,
                           Ties ties) {
  return Sight(segment, obstacles, ties).DecideByAllCells();
}

}  // namespace farhorizon
