// The clearance of an edge is a function of two numbers, t and the direction's angle. Over each
// obstacle it is smooth, and the least of them counts: a landscape of creases, whose summits are
// mostly where three obstacles tie. So the smooth functions are replaced by their tangent planes,
// the highest point under these planes in a box around the line is the next line to be tried, and
// the box shrinks where that is no higher: Newton's method where three obstacles meet. Obstacles
// become known as the highest edges over the lines that were tried.
#include "core/horizon/lines_of_sight/clearance_climb.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "core/horizon/lines_of_sight/small_linear_program.h"

namespace farhorizon {

namespace {

// A step that is tried goes up to this far: at first a quarter of the edge, and of a radian, and
// half of each at most. Any lengths are sound, these are fast.
constexpr double kFirstReach = 0.25;
constexpr double kMostReach = 0.5;
// Where steps get shorter than this, the line is at a summit as far as doubles need to tell.
constexpr double kLeastReach = 1e-5;
// Any number is sound: what is not found here, the proof finds.
constexpr int kMostSteps = 24;

}  // namespace

ClearanceClimb::ClearanceClimb(const Terrain& terrain, const GridLineQuery& lines, Edge edge)
    : terrain_(terrain),
      lines_(lines),
      edge_(edge),
      start_(terrain.Point(edge.a)),
      run_x_(static_cast<double>(terrain.Point(edge.b).x) - start_.x),
      run_y_(static_cast<double>(terrain.Point(edge.b).y) - start_.y),
      climb_(static_cast<double>(terrain.Point(edge.b).z) - start_.z),
      slack_(lines.HeightError()) {
  const Terrain::Faces faces = terrain.FacesOf(edge);
  for (const std::optional<VertexId> third : {faces.left, faces.right}) {
    if (!third) continue;
    Add(MakeEdge(edge.a, *third));
    Add(MakeEdge(edge.b, *third));
  }
}

ClearanceClimb::Line ClearanceClimb::LineThrough(double t, double dc, double dr) {
  return {t, std::atan2(dr, dc)};
}

void ClearanceClimb::Add(Edge edge) {
  if (std::find(edges_.begin(), edges_.end(), edge) != edges_.end()) return;
  edges_.push_back(edge);
  const Point3i a = terrain_.Point(edge.a);
  const Point3i b = terrain_.Point(edge.b);
  obstacles_.push_back({static_cast<double>(a.x) - start_.x, static_cast<double>(a.y) - start_.y,
                        static_cast<double>(a.z) - start_.z, static_cast<double>(b.x) - a.x,
                        static_cast<double>(b.y) - a.y, static_cast<double>(b.z) - a.z});
}

double ClearanceClimb::ClearanceOver(const Line& line) {
  // A line query passes about a block of posts, as long as a decision, for so many columns and
  // rows.
  constexpr std::int64_t kBlock = 8;
  work_ += (terrain_.dem().columns + terrain_.dem().rows) / kBlock + 1;
  const double known = ClearanceOverObstacles(line);
  const double own = start_.z + line.t * climb_;
  const std::optional<HighestEdge> other =
      lines_.HighestEdgeOver(edge_,
                             {start_.x + line.t * run_x_, start_.y + line.t * run_y_,
                              std::cos(line.angle), std::sin(line.angle)},
                             own - known);
  if (!other) return std::isfinite(known) ? known - slack_ : 0;
  Add(other->edge);
  return own - other->height - slack_;
}

double ClearanceClimb::ClearanceOverObstacles(const Line& line) const {
  const double ux = std::cos(line.angle);
  const double uy = std::sin(line.angle);
  double least = std::numeric_limits<double>::infinity();
  for (const Obstacle& f : obstacles_) {
    const double part = ux * (line.t * run_y_ - f.y) - uy * (line.t * run_x_ - f.x);
    const double whole = ux * f.run_y - uy * f.run_x;
    if (part * whole < 0 || std::abs(part) > std::abs(whole) || whole == 0) continue;
    least = std::min(least, line.t * climb_ - f.z - part / whole * f.rise);
  }
  return least;
}

// The line crosses the obstacle at the share s = cross(u, p) / cross(u, run) of it, p being the
// edge's point from the obstacle's first end.
std::optional<ClearanceClimb::Plane> ClearanceClimb::PlaneOf(const Obstacle& obstacle,
                                                             const Line& line, double reach) const {
  const double ux = std::cos(line.angle);
  const double uy = std::sin(line.angle);
  const double px = line.t * run_x_ - obstacle.x;
  const double py = line.t * run_y_ - obstacle.y;
  const double whole = ux * obstacle.run_y - uy * obstacle.run_x;
  if (whole == 0) return std::nullopt;
  const double share = (ux * py - uy * px) / whole;
  const double by_t = (ux * run_y_ - uy * run_x_) / whole;
  // u turns towards (-uy, ux).
  const double by_angle =
      (-uy * py - ux * px + share * (uy * obstacle.run_y + ux * obstacle.run_x)) / whole;
  const double most = reach * (std::abs(by_t) + std::abs(by_angle));
  if (share < -most || share > 1 + most) return std::nullopt;
  return Plane{line.t * climb_ - obstacle.z - share * obstacle.rise, climb_ - by_t * obstacle.rise,
               -by_angle * obstacle.rise};
}

ClearanceClimb::Step ClearanceClimb::BestStep(const Line& line, double reach) const {
  std::vector<LinearBound> bounds;
  bounds.push_back({{1, 0, 0}, std::min(reach, 1 - line.t)});
  bounds.push_back({{-1, 0, 0}, std::min(reach, line.t)});
  bounds.push_back({{0, 1, 0}, reach});
  bounds.push_back({{0, -1, 0}, reach});
  std::array<std::size_t, 3> basis = {0, 2, 0};
  double lowest = 0;
  for (const Obstacle& obstacle : obstacles_) {
    const std::optional<Plane> plane = PlaneOf(obstacle, line, reach);
    if (!plane) continue;
    if (basis[2] == 0 || plane->value < lowest) {
      lowest = plane->value;
      basis = {plane->by_t >= 0 ? 0U : 1U, plane->by_angle >= 0 ? 2U : 3U, bounds.size()};
    }
    bounds.push_back({{-plane->by_t, -plane->by_angle, 1}, plane->value});
  }
  if (basis[2] == 0) return {};
  const std::array<double, 3> best = GreatestLast(bounds, basis);
  return {best[0], best[1], best[2]};
}

double ClearanceClimb::ClimbFrom(const Line& from, double tolerance, double relative) {
  Line line = from;
  double clearance = ClearanceOver(line);
  double reach = kFirstReach;
  for (int i = 0; i < kMostSteps && reach > kLeastReach; ++i) {
    const Step step = BestStep(line, reach);
    const double gain = step.clearance - clearance;
    if (!(gain > std::max(tolerance, relative * clearance) / 2)) {
      reach *= 0.25;
      continue;
    }
    const Line next{std::clamp(line.t + step.t, 0.0, 1.0), line.angle + step.angle};
    double reached = ClearanceOverObstacles(next);
    if (reached > clearance) reached = ClearanceOver(next);
    const double share = (reached - clearance) / gain;
    if (share > 0) {
      line = next;
      clearance = reached;
    }
    if (share < 0.25) {
      reach *= share > 0 ? 0.5 : 0.25;
    } else if (share > 0.75) {
      reach = std::min(2 * reach, kMostReach);
    }
  }
  return clearance;
}

}  // namespace farhorizon
