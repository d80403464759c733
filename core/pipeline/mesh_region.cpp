// Longitudes go round, so that their least and greatest mean nothing by themselves: the widest gap
// between those of the meshes decides where the region ends. They are gathered by whole degrees.
// An edge is a straight line through the globe. Its longitudes lie between those of its ends, by
// the shorter way; its latitudes may go beyond both, towards a pole; its heights below both.
#include "core/pipeline/mesh_region.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

namespace farhorizon {

namespace {

constexpr int kDegrees = 360;
// No section of the ellipsoid is more bent: a (1 - e^2) of WGS 84, at the equator, is 6335439 m.
constexpr double kLeastRadiusM = 6335000;
constexpr double kRadiansPerDegree = std::numbers::pi / 180;
// No degree of latitude is shorter.
constexpr double kLeastMetresPerDegree = kLeastRadiusM * kRadiansPerDegree;
// A point nearer to a pole than this, a tenth of a millimetre, has no longitude of its own.
constexpr double kPoleDeg = 90 - 1e-9;

bool IsPole(const Geodetic& p) { return std::abs(p.lat_deg) >= kPoleDeg; }

// In [-180, 180): one meridian, one number.
double Within(double lon_deg) { return lon_deg >= 180 ? lon_deg - kDegrees : lon_deg; }

std::size_t DegreeOf(double lon_deg) {
  return static_cast<std::size_t>(std::floor(Within(lon_deg) + 180));
}

double TurnFrom(const Geodetic& a, const Geodetic& b) {
  return std::remainder(b.lon_deg - a.lon_deg, kDegrees);
}

// Where the line from a to b, in earth-fixed axes, comes nearest to a pole by latitude; nullopt
// where that is at an end. With p = a + t d, the geocentric latitude z / sqrt(x^2 + y^2) is extreme
// where its square's derivative is zero, which is linear in t.
std::optional<Ecef> Poleward(const Ecef& a, const Ecef& b) {
  const Ecef d = {b.x - a.x, b.y - a.y, b.z - a.z};
  const double aa = a.x * a.x + a.y * a.y;
  const double ad = a.x * d.x + a.y * d.y;
  const double dd = d.x * d.x + d.y * d.y;
  const double t = (d.z * aa - a.z * ad) / (a.z * dd - d.z * ad);
  if (!(t > 0 && t < 1)) return std::nullopt;
  return Ecef{a.x + t * d.x, a.y + t * d.y, a.z + t * d.z};
}

}  // namespace

void MeshRegion::AddPoint(const Geodetic& p) {
  south_ = std::min(south_, p.lat_deg);
  north_ = std::max(north_, p.lat_deg);
  if (IsPole(p)) return;
  Span& span = spans_[DegreeOf(p.lon_deg)];
  span.least = std::min(span.least, Within(p.lon_deg));
  span.greatest = std::max(span.greatest, Within(p.lon_deg));
}

void MeshRegion::AddEdge(const Geodetic& a, const Geodetic& b) {
  if (IsPole(a) || IsPole(b)) return;
  const bool eastwards = TurnFrom(a, b) >= 0;
  const std::size_t last = DegreeOf((eastwards ? b : a).lon_deg);
  for (std::size_t i = DegreeOf((eastwards ? a : b).lon_deg);; i = (i + 1) % kDegrees) {
    spans_[i].crossed = true;
    if (i == last) return;
  }
}

void MeshRegion::AddTriangle(const std::array<Geodetic, 3>& corners) {
  double turn = 0;
  for (std::size_t k = 0; k < 3; ++k) {
    AddEdge(corners[k], corners[(k + 1) % 3]);
    turn += TurnFrom(corners[k], corners[(k + 1) % 3]);
  }
  if (std::abs(turn) < 180 || std::ranges::any_of(corners, IsPole)) return;
  // The corners go all the way round: a pole is inside.
  (corners[0].lat_deg > 0 ? north_ : south_) = corners[0].lat_deg > 0 ? 90 : -90;
}

Status MeshRegion::Add(const LocalMesh& mesh) {
  const TangentFrame& frame = georeference_->frame();
  Result<std::vector<Geodetic>> vertices = georeference_->ToGeodetic(mesh.positions);
  if (!vertices) return std::move(vertices.error());
  for (const Geodetic& p : *vertices) {
    AddPoint(p);
    least_m_ = std::min(least_m_, p.height_m);
    greatest_m_ = std::max(greatest_m_, p.height_m);
  }
  constexpr std::size_t kBatch = 4096;
  std::vector<Enu> poleward;
  const auto flush = [&]() -> Status {
    Result<std::vector<Geodetic>> points = georeference_->ToGeodetic(poleward);
    if (!points) return std::move(points.error());
    poleward.clear();
    for (const Geodetic& p : *points) {
      south_ = std::min(south_, p.lat_deg);
      north_ = std::max(north_, p.lat_deg);
    }
    return Ok{};
  };
  for (const auto& t : mesh.triangles) {
    AddTriangle({(*vertices)[t[0]], (*vertices)[t[1]], (*vertices)[t[2]]});
    for (std::size_t k = 0; k < 3; ++k) {
      const Enu& from = mesh.positions[t[k]];
      const Enu& to = mesh.positions[t[(k + 1) % 3]];
      longest_m_ = std::max(
          longest_m_, std::hypot(to.east - from.east, to.north - from.north, to.up - from.up));
      const std::optional<Ecef> nearest = Poleward(frame.ToEcef(from), frame.ToEcef(to));
      if (nearest) poleward.push_back(frame.ToEnu(*nearest));
    }
    if (poleward.size() < kBatch) continue;
    if (Status flushed = flush(); !flushed) return flushed;
  }
  return flush();
}

void MeshRegion::Add(const MeshRegion& other) {
  for (std::size_t i = 0; i < spans_.size(); ++i) {
    Span& span = spans_[i];
    const Span& more = other.spans_[i];
    span.least = std::min(span.least, more.least);
    span.greatest = std::max(span.greatest, more.greatest);
    span.crossed = span.crossed || more.crossed;
  }
  south_ = std::min(south_, other.south_);
  north_ = std::max(north_, other.north_);
  least_m_ = std::min(least_m_, other.least_m_);
  greatest_m_ = std::max(greatest_m_, other.greatest_m_);
  longest_m_ = std::max(longest_m_, other.longest_m_);
}

BoundingRegion MeshRegion::Box(double slack_m) const {
  BoundingRegion region = {-std::numbers::pi,
                           south_ * kRadiansPerDegree,
                           std::numbers::pi,
                           north_ * kRadiansPerDegree,
                           least_m_ - longest_m_ * longest_m_ / (8 * kLeastRadiusM),
                           greatest_m_};
  // The widest gap: `gap` degrees that no edge crosses, before degree `after`.
  int gap = 0;
  std::size_t after = 0;
  int run = 0;
  for (std::size_t i = 0; i < 2 * kDegrees; ++i) {
    if (!spans_[i % kDegrees].crossed) {
      ++run;
      continue;
    }
    if (run > gap) {
      gap = run;
      after = i % kDegrees;
    }
    run = 0;
  }
  if (gap == 0) return region;
  const std::size_t before = (after + 2 * kDegrees - static_cast<std::size_t>(gap) - 1) % kDegrees;
  double west = spans_[after].least;
  double east = spans_[before].greatest;
  // A degree of longitude is shorter by the cosine of the latitude. From 84 degrees on vertices may
  // stay over the meridian: next to a pole no slack would tell them from a mesh on both its sides.
  const double widest = std::max(std::abs(south_), std::abs(north_));
  const double shortened = std::max(0.1, std::cos(widest * kRadiansPerDegree));
  const double slack_deg = slack_m / (kLeastMetresPerDegree * shortened);
  if (west > east && east + 180 <= slack_deg) east = 180;
  if (west > east && 180 - west <= slack_deg) west = -180;
  region.west = west * kRadiansPerDegree;
  region.east = east * kRadiansPerDegree;
  return region;
}

}  // namespace farhorizon
