// A level leaves its tangent frame here for longitude and latitude in whole numbers, in which tiles
// are cut: whether a vertex lies on a tile's side is then no matter of rounding. What tiles cover
// beside the ground is triangulated between the ground's sides and a box, and is the globe or a
// void by what it is joined to.
#include "core/pipeline/terrain_tiles/globe_mesh.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include "core/geo/ellipsoid.h"
#include "core/geometry/union_find.h"

namespace farhorizon {

namespace {

constexpr double kUnitsPerDegree = static_cast<double>(kHalfTurn) / 180;
// A degree of longitude is 200 m long there. Nearer to a pole triangles of any size in metres are
// many degrees wide, and a tile's meridians meet.
constexpr double kMostLatitudeDeg = 89.9;
// No triangle of a DEM is as wide, away from the poles; one that goes round a pole is wider.
constexpr std::int64_t kWidestTriangle = kHalfTurn / 2;

Error AroundPole() {
  return {ErrorCode::kUnsupportedData,
          "the DEM is within 11 km of a pole or goes round one, and tiles of longitude and "
          "latitude cannot show it; leave quantized-mesh out of --formats",
          "too-large-extent"};
}

// Earth-fixed, of length 1.
std::array<float, 3> ToEarthFixed(const TangentFrame& frame, const UnitNormal& n) {
  const std::array<double, 16> m = frame.EnuToEcef();
  std::array<float, 3> turned{};
  for (std::size_t k = 0; k < 3; ++k) {
    turned[k] = static_cast<float>(m[k] * n[0] + m[4 + k] * n[1] + m[8 + k] * n[2]);
  }
  return turned;
}

using Side = std::array<std::uint32_t, 2>;

// The sides of triangles that have no triangle on the other side; each with its triangle to the
// left.
std::vector<Side> SidesOf(const std::vector<std::array<std::uint32_t, 3>>& triangles) {
  // Each edge by its lesser vertex first, and whether it runs so.
  struct Run {
    Side edge;
    bool rising;
    auto operator<=>(const Run&) const = default;
  };
  std::vector<Run> runs;
  runs.reserve(triangles.size() * 3);
  for (const auto& t : triangles) {
    for (std::size_t k = 0; k < 3; ++k) {
      const std::uint32_t a = t[k];
      const std::uint32_t b = t[(k + 1) % 3];
      runs.push_back({{std::min(a, b), std::max(a, b)}, a < b});
    }
  }
  std::sort(runs.begin(), runs.end());
  std::vector<Side> sides;
  for (std::size_t i = 0; i < runs.size();) {
    std::size_t end = i + 1;
    while (end < runs.size() && runs[end].edge == runs[i].edge) ++end;
    if (end - i == 1) {
      const auto [a, b] = runs[i].edge;
      sides.push_back(runs[i].rising ? Side{a, b} : Side{b, a});
    }
    i = end;
  }
  return sides;
}

// Which of the triangles are joined to the first of them by sides that are none of `sides`.
class Outside {
 public:
  Outside(const std::vector<std::array<std::uint32_t, 3>>& triangles, std::vector<Side> sides)
      : parents_(triangles.size()) {
    std::iota(parents_.begin(), parents_.end(), 0);
    for (Side& side : sides) side = {std::min(side[0], side[1]), std::max(side[0], side[1])};
    std::sort(sides.begin(), sides.end());
    std::vector<std::pair<Side, std::int32_t>> edges;
    edges.reserve(triangles.size() * 3);
    for (std::size_t i = 0; i < triangles.size(); ++i) {
      for (std::size_t k = 0; k < 3; ++k) {
        const std::uint32_t a = triangles[i][k];
        const std::uint32_t b = triangles[i][(k + 1) % 3];
        edges.push_back({{std::min(a, b), std::max(a, b)}, static_cast<std::int32_t>(i)});
      }
    }
    std::sort(edges.begin(), edges.end());
    for (std::size_t i = 1; i < edges.size(); ++i) {
      if (edges[i].first != edges[i - 1].first) continue;
      if (std::binary_search(sides.begin(), sides.end(), edges[i].first)) continue;
      const std::int32_t root = FindRoot(parents_, edges[i].second);
      parents_[static_cast<std::size_t>(root)] = FindRoot(parents_, edges[i - 1].second);
    }
  }

  bool AreJoined(std::size_t a, std::size_t b) {
    return FindRoot(parents_, static_cast<std::int32_t>(a)) ==
           FindRoot(parents_, static_cast<std::int32_t>(b));
  }

 private:
  std::vector<std::int32_t> parents_;
};

}  // namespace

Geodetic GeodeticOf(const LatticePoint& place, double height_m) {
  return {static_cast<double>(place.x) / kUnitsPerDegree - 180,
          static_cast<double>(place.y) / kUnitsPerDegree - 90, height_m};
}

std::array<float, 3> UpAt(const LatticePoint& place) {
  const Geodetic p = GeodeticOf(place, 0);
  const double lat = p.lat_deg * kRadiansPerDegree;
  const double lon = p.lon_deg * kRadiansPerDegree;
  return {static_cast<float>(std::cos(lat) * std::cos(lon)),
          static_cast<float>(std::cos(lat) * std::sin(lon)), static_cast<float>(std::sin(lat))};
}

Result<GlobeMesh> PlaceOnGlobe(const Georeference& georeference, const LocalMesh& mesh) {
  Result<std::vector<Geodetic>> geodetic = georeference.ToGeodetic(mesh.positions);
  if (!geodetic) return std::move(geodetic.error());
  const double middle_deg = georeference.middle().lon_deg;
  std::vector<GlobeVertex> vertices;
  vertices.reserve(mesh.positions.size());
  for (std::size_t i = 0; i < geodetic->size(); ++i) {
    const Geodetic& p = (*geodetic)[i];
    if (!(std::abs(p.lat_deg) <= kMostLatitudeDeg)) return AroundPole();
    const double lon_deg = middle_deg + std::remainder(p.lon_deg - middle_deg, 360);
    vertices.push_back({{std::llround((lon_deg + 180) * kUnitsPerDegree),
                         std::llround((p.lat_deg + 90) * kUnitsPerDegree)},
                        p.height_m,
                        ToEarthFixed(georeference.frame(), mesh.normals[i])});
  }
  // Draco has a vertex for each fan of triangles around a post; here they are one.
  std::vector<std::uint32_t> order(vertices.size());
  std::iota(order.begin(), order.end(), 0U);
  std::stable_sort(order.begin(), order.end(), [&vertices](std::uint32_t a, std::uint32_t b) {
    return vertices[a].place < vertices[b].place;
  });
  std::vector<std::uint32_t> one(vertices.size());
  for (std::size_t i = 0; i < order.size(); ++i) {
    const bool same = i > 0 && vertices[order[i]].place == vertices[order[i - 1]].place;
    one[order[i]] = same ? one[order[i - 1]] : order[i];
  }
  GlobeMesh globe;
  globe.ground.triangles.reserve(mesh.triangles.size());
  for (const auto& t : mesh.triangles) {
    const std::array<std::uint32_t, 3> corners = {one[t[0]], one[t[1]], one[t[2]]};
    const auto [least, greatest] =
        std::minmax({vertices[t[0]].place.x, vertices[t[1]].place.x, vertices[t[2]].place.x});
    if (greatest - least > kWidestTriangle) return AroundPole();
    globe.ground.triangles.push_back(corners);
  }
  globe.vertices = std::move(vertices);
  return globe;
}

PlaceBox BoxAround(const GlobeMesh& mesh) {
  PlaceBox box = {mesh.vertices.front().place, mesh.vertices.front().place};
  for (const GlobeVertex& vertex : mesh.vertices) {
    if (!vertex.is_ground) continue;
    box.least = {std::min(box.least.x, vertex.place.x), std::min(box.least.y, vertex.place.y)};
    box.greatest = {std::max(box.greatest.x, vertex.place.x),
                    std::max(box.greatest.y, vertex.place.y)};
  }
  return box;
}

Result<GlobePart> CoverBox(GlobeMesh& mesh, const PlaceBox& box) {
  const std::vector<Side> sides = SidesOf(mesh.ground.triangles);
  // The points that bound what is to be covered: the ground's sides, and the corners of the box.
  std::vector<std::uint32_t> ground;
  for (const Side& side : sides) ground.insert(ground.end(), side.begin(), side.end());
  std::sort(ground.begin(), ground.end());
  ground.erase(std::unique(ground.begin(), ground.end()), ground.end());
  const auto number = [&ground](std::uint32_t vertex) {
    return static_cast<std::uint32_t>(std::lower_bound(ground.begin(), ground.end(), vertex) -
                                      ground.begin());
  };
  const auto corner = static_cast<std::uint32_t>(ground.size());
  std::vector<LatticePoint> points;
  points.reserve(ground.size() + 4);
  for (const std::uint32_t vertex : ground) points.push_back(mesh.vertices[vertex].place);
  points.insert(
      points.end(),
      {box.least, {box.greatest.x, box.least.y}, box.greatest, {box.least.x, box.greatest.y}});
  std::vector<Side> bounds;
  bounds.reserve(sides.size() + 4);
  for (const auto& [a, b] : sides) bounds.push_back({number(a), number(b)});
  for (std::uint32_t k = 0; k < 4; ++k) bounds.push_back({corner + k, corner + (k + 1) % 4});
  Result<std::vector<std::array<std::uint32_t, 3>>> cover = TriangulateInside(points, bounds);
  if (!cover) return std::move(cover.error());

  // The globe around the ground is what is joined to a corner of the box.
  const auto outermost = std::find_if(cover->begin(), cover->end(), [corner](const auto& t) {
    return std::any_of(t.begin(), t.end(), [corner](std::uint32_t p) { return p >= corner; });
  });
  Check(outermost != cover->end(), "a box has corners");
  Outside outside(*cover, bounds);
  const auto first_fill = static_cast<std::uint32_t>(mesh.vertices.size());
  for (const LatticePoint& p : points) mesh.vertices.push_back({p, 0, UpAt(p), 0, false});
  GlobePart part = mesh.ground;
  std::vector<Side> fill_sides;
  for (std::size_t i = 0; i < cover->size(); ++i) {
    const auto& t = (*cover)[i];
    const bool is_fill = outside.AreJoined(i, static_cast<std::size_t>(outermost - cover->begin()));
    const auto vertex = [&](std::uint32_t p) { return is_fill ? first_fill + p : ground[p]; };
    part.triangles.push_back({vertex(t[0]), vertex(t[1]), vertex(t[2])});
    if (!is_fill) continue;
    for (std::size_t k = 0; k < 3; ++k) fill_sides.push_back({t[(k + 1) % 3], t[k]});
  }
  std::sort(fill_sides.begin(), fill_sides.end());
  for (const auto& [a, b] : sides) {
    const Side side = {number(a), number(b)};
    if (!std::binary_search(fill_sides.begin(), fill_sides.end(), side)) continue;
    part.walls.push_back({a, b, first_fill + side[1], first_fill + side[0]});
  }
  return part;
}

}  // namespace farhorizon
