// A post's vertical meets the triangle that has the post in plan, or one close by, as the sides of
// triangles that are straight in space are not quite straight in the frame of the grid: from
// triangle to triangle, over the side beyond which it lies furthest, the vertical is followed to
// the one that it meets.
#include "core/measure/verticals.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace farhorizon {

// Where a vertical meets a triangle's plane.
struct Verticals::Meeting {
  std::array<double, 3> shares{};  // barycentric coordinates, all times `whole`
  double whole = 0;
  double above = 0;  // along the vertical, above the post
  // The corner with the most negative share; none: the triangle itself is met.
  std::size_t outside = 3;
};

namespace {

using Vector3 = StraightPoint;

// Triangles that a vertical is followed through. Sides of 1000 cells on a degree bend by 8.
constexpr int kMostSteps = 256;

Vector3 Minus(const Vector3& p, const Vector3& q) {
  return {p[0] - q[0], p[1] - q[1], p[2] - q[2]};
}

double Dot(const Vector3& p, const Vector3& q) { return p[0] * q[0] + p[1] * q[1] + p[2] * q[2]; }

// The determinant of p, q, r; its sign turns exactly when p and q are exchanged.
double Determinant(const Vector3& p, const Vector3& q, const Vector3& r) {
  return Dot({p[1] * q[2] - p[2] * q[1], p[2] * q[0] - p[0] * q[2], p[0] * q[1] - p[1] * q[0]}, r);
}

}  // namespace

std::optional<double> Verticals::DistanceAt(VertexId v, std::int32_t triangle) const {
  const Vector3 post = PlaceOf(v);
  const Vector3 up = UpAt(post);
  const Meeting first = Meet(triangle, post, up);
  Meeting meeting = first;
  for (int step = 0; meeting.outside < 3; ++step) {
    // A mesh that folds may lead in circles: the plane that the plan names is taken then.
    if (step == kMostSteps) return std::abs(first.above);
    const std::int32_t side =
        sides_.of_triangle[static_cast<std::size_t>(triangle)][meeting.outside];
    triangle = sides_.sides[static_cast<std::size_t>(side)].Beyond(triangle);
    if (triangle == kNoneThere) return std::nullopt;
    meeting = Meet(triangle, post, up);
  }
  return std::abs(meeting.above);
}

double Verticals::DistanceAtOutline(VertexId v, const MeshSide& side, double t,
                                    bool with_plane) const {
  const Vector3 post = PlaceOf(v);
  const Vector3 up = UpAt(post);
  const Vector3 a = Minus(Straight(side.a), post);
  const Vector3 b = Minus(Straight(side.b), post);
  const double error = std::abs(std::lerp(Dot(a, up), Dot(b, up), t));
  if (!with_plane) return error;
  const std::int32_t triangle = side.left != kNoneThere ? side.left : side.right;
  const Meeting plane = Meet(triangle, post, up);
  if (!std::isfinite(plane.above)) return error;
  // No further beyond the triangle than it is high: a thin one may be steep.
  const double third = Dot(Minus(Straight(ThirdOf(triangle, side)), post), up);
  const auto [least, most] = std::minmax({Dot(a, up), Dot(b, up), third});
  return std::max(error, std::abs(std::clamp(plane.above, 2 * least - most, 2 * most - least)));
}

StraightPoint Verticals::Straight(std::int32_t point) const {
  const auto at = static_cast<std::size_t>(point);
  if (!mesh_.straight.empty()) return mesh_.straight[at];
  const GridPoint& p = mesh_.grid.points[at];
  return {p.column, p.row, p.height_m};
}

StraightPoint Verticals::PlaceOf(VertexId v) const {
  if (!places_.positions.empty()) return places_.positions[static_cast<std::size_t>(v)];
  return {static_cast<double>(dem_.Column(v)), static_cast<double>(dem_.Row(v)), dem_.HeightM(v)};
}

// The vertical at p, of length 1.
StraightPoint Verticals::UpAt(const StraightPoint& p) const {
  if (places_.positions.empty()) return {0, 0, 1};
  Vector3 up = places_.up_at_origin;
  for (std::size_t k = 0; k < 3; ++k) {
    up[k] += Dot({places_.up[3 * k], places_.up[3 * k + 1], places_.up[3 * k + 2]}, p);
  }
  const double length = std::sqrt(Dot(up, up));
  return {up[0] / length, up[1] / length, up[2] / length};
}

Verticals::Meeting Verticals::Meet(std::int32_t triangle, const StraightPoint& post,
                                   const StraightPoint& up) const {
  const std::array<std::int32_t, 3>& corners =
      mesh_.grid.triangles[static_cast<std::size_t>(triangle)];
  const std::array<Vector3, 3> to = {Minus(Straight(corners[0]), post),
                                     Minus(Straight(corners[1]), post),
                                     Minus(Straight(corners[2]), post)};
  Meeting meeting;
  for (std::size_t k = 0; k < 3; ++k) {
    meeting.shares[k] = Determinant(to[(k + 1) % 3], to[(k + 2) % 3], up);
    meeting.whole += meeting.shares[k];
    meeting.above += meeting.shares[k] * Dot(to[k], up);
  }
  meeting.above /= meeting.whole;
  double least = 0;
  for (std::size_t k = 0; k < 3; ++k) {
    const double share = meeting.whole > 0 ? meeting.shares[k] : -meeting.shares[k];
    if (share >= least) continue;
    least = share;
    meeting.outside = k;
  }
  return meeting;
}

std::int32_t Verticals::ThirdOf(std::int32_t triangle, const MeshSide& side) const {
  for (const std::int32_t i : mesh_.grid.triangles[static_cast<std::size_t>(triangle)]) {
    if (i != side.a && i != side.b) return i;
  }
  return side.a;
}

}  // namespace farhorizon
