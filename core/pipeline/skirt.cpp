// The rim is what its triangles say: a side that one triangle has and no other has the other way
// round. A wall takes that side the other way round and two posts down:
//
//        surface            seen from outside, the ground behind the rim
//     a ---------> b        wall: (a', b', b) and (a', b, a)
//     |            |
//     a' --------- b'
#include "core/pipeline/skirt.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <iterator>
#include <utility>

#include "core/geo/ellipsoid_normal.h"

namespace farhorizon {

namespace {

using Side = std::pair<std::uint32_t, std::uint32_t>;

constexpr double kThinnestShare = 1.0 / 512;
constexpr double kEarthRadiusM = 6371000;  // mean; any value within a percent serves

// The sides of one triangle only, from post to post, rising.
std::vector<Side> RimOf(const LocalMesh& mesh) {
  std::vector<Side> sides;
  sides.reserve(3 * mesh.triangles.size());
  for (const auto& t : mesh.triangles) {
    for (std::size_t k = 0; k < 3; ++k) {
      sides.emplace_back(mesh.posts[t[k]], mesh.posts[t[(k + 1) % 3]]);
    }
  }
  std::ranges::sort(sides);
  std::vector<Side> rim;
  std::ranges::copy_if(sides, std::back_inserter(rim), [&sides](const Side& side) {
    return !std::ranges::binary_search(sides, Side(side.second, side.first));
  });
  return rim;
}

// `depth_m` downwards at `p`, in whole steps.
Enu StepsDown(const Enu& p, const TangentFrame& frame, double depth_m, double step_m) {
  const Enu up = EllipsoidNormal(p, frame);
  const double share = -depth_m / std::hypot(up.east, up.north, up.up);
  const auto round = [&](double x) { return std::nearbyint(share * x / step_m) * step_m; };
  return {round(up.east), round(up.north), round(up.up)};
}

double DiagonalOf(const TerrainInput& input) {
  const Georeference& georeference = input.georeference();
  return std::hypot(georeference.column_step_m() * (input.dem().columns - 1),
                    georeference.row_step_m() * (input.dem().rows - 1));
}

double ReliefOf(const TerrainInput& input) {
  const auto& [least_m, greatest_m] = input.report().heights_m;
  return greatest_m - least_m;
}

}  // namespace

LocalMesh SkirtOf(const LocalMesh& surface, const TangentFrame& frame,
                  const QuantizationLattice& lattice, double depth_m) {
  const std::vector<Side> rim = RimOf(surface);
  LocalMesh skirt;
  for (const auto& [a, b] : rim) skirt.posts.insert(skirt.posts.end(), {a, b});
  std::ranges::sort(skirt.posts);
  const auto repeated = std::ranges::unique(skirt.posts);
  skirt.posts.erase(repeated.begin(), repeated.end());
  const std::size_t count = skirt.posts.size();
  const auto top = [&](std::uint32_t post) {
    return static_cast<std::uint32_t>(std::ranges::lower_bound(skirt.posts, post) -
                                      skirt.posts.begin());
  };
  skirt.positions.resize(2 * count);
  skirt.normals.resize(2 * count);
  for (std::size_t v = 0; v < surface.posts.size(); ++v) {
    const std::uint32_t i = top(surface.posts[v]);
    if (i == count || skirt.posts[i] != surface.posts[v]) continue;
    const Enu& p = surface.positions[v];
    const Enu down = StepsDown(p, frame, depth_m, lattice.step_m);
    skirt.positions[i] = p;
    skirt.positions[count + i] = {p.east + down.east, p.north + down.north, p.up + down.up};
    skirt.normals[i] = skirt.normals[count + i] = surface.normals[v];
  }
  skirt.triangles.reserve(2 * rim.size());
  const auto below = static_cast<std::uint32_t>(count);
  for (const auto& [from, to] : rim) {
    const std::uint32_t a = top(from);
    const std::uint32_t b = top(to);
    skirt.triangles.push_back({below + a, below + b, b});
    skirt.triangles.push_back({below + a, b, a});
  }
  const std::vector<std::uint32_t> posts = skirt.posts;
  skirt.posts.insert(skirt.posts.end(), posts.begin(), posts.end());
  return skirt;
}

double MostSkirtDepth(const TerrainInput& input, std::optional<double> asked_m) {
  if (asked_m) return *asked_m;
  // A level is off by no more than the relief and the Earth's bend under the longest edge.
  const double diagonal_m = DiagonalOf(input);
  const double bend_m = diagonal_m * diagonal_m / (8 * kEarthRadiusM);
  return 3 * ReliefOf(input) + 2 * bend_m + kThinnestShare * diagonal_m;
}

std::vector<double> SkirtDepths(const TerrainInput& input, const std::vector<LevelReport>& levels,
                                std::optional<double> asked_m) {
  std::vector<double> depths;
  depths.reserve(levels.size());
  const LevelReport& coarsest = levels.back();
  for (const LevelReport& level : levels) {
    const double errors_m =
        level.geometric_error_m + coarsest.geometric_error_m + coarsest.side_step_m;
    const double deep_m = ReliefOf(input) + std::max(errors_m, kThinnestShare * DiagonalOf(input));
    const double wanted_m = asked_m ? *asked_m : std::min(deep_m, MostSkirtDepth(input, asked_m));
    const double step_m = level.quantization_step_m;
    depths.push_back(std::ceil(wanted_m / step_m) * step_m);
  }
  return depths;
}

}  // namespace farhorizon
