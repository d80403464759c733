// A chain stands for several edges of the DEM and has the rounded places of their posts. So its
// edges are read off it, by the posts nearest to its points, and the chains that ought to be there
// are made anew of the edges that were found again: both lists must have the same posts in the same
// order, and each point and weight must be that of its twin but for its last digit.
#include "core/pipeline/verify/verify_chains.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <utility>

namespace farhorizon {

namespace {

// Weights have four digits.
bool Close(double claimed, double found) {
  return std::abs(claimed - found) <= 1e-3 * std::abs(found) + 1e-9;
}

bool Near(const std::vector<Geodetic>& claimed, const std::vector<Geodetic>& found,
          const ChainRounding& rounding) {
  const double degrees = 0.6 * std::pow(10, -rounding.degree_decimals);
  const double metres = 0.6 * std::pow(10, -rounding.metre_decimals);
  return std::ranges::equal(claimed, found, [&](const Geodetic& a, const Geodetic& b) {
    return std::abs(std::remainder(a.lon_deg - b.lon_deg, 360)) < degrees &&
           std::abs(a.lat_deg - b.lat_deg) < degrees && std::abs(a.height_m - b.height_m) < metres;
  });
}

bool SameWeights(const HorizonChain& claimed, const HorizonChain& found) {
  return claimed.undecided == found.undecided && claimed.in_context == found.in_context &&
         claimed.sights == found.sights && claimed.drop == found.drop &&
         claimed.azimuths == found.azimuths &&
         Close(claimed.line_measure_m, found.line_measure_m) &&
         Close(claimed.skyline_drop_m, found.skyline_drop_m);
}

// Names the posts of chains that were read: each is the nearest to its point.
Status NamePosts(const Georeference& georeference, std::vector<HorizonChain>& chains) {
  std::vector<Geodetic> points;
  for (const HorizonChain& chain : chains) {
    points.insert(points.end(), chain.line.begin(), chain.line.end());
  }
  Result<std::vector<Enu>> local = georeference.ToEnu(points);
  if (!local) return std::move(local.error());
  Result<std::vector<GridPoint>> grid = georeference.ToGrid(*local);
  if (!grid) return std::move(grid.error());
  auto next = grid->begin();
  for (HorizonChain& chain : chains) {
    for (std::size_t i = 0; i < chain.line.size(); ++i, ++next) {
      chain.posts.push_back({static_cast<std::int32_t>(std::lround(next->column)),
                             static_cast<std::int32_t>(std::lround(next->row))});
    }
  }
  return Ok{};
}

}  // namespace

PublishedEdges VerifyChains(const TerrainInput& input, std::vector<HorizonChain> chains,
                            const std::vector<HorizonFeature>& found, Claims& claims) {
  const Dem& dem = input.dem();
  PublishedEdges published;
  if (Status named = NamePosts(input.georeference(), chains); !named) {
    claims.Add(false, "horizon.geojson has no posts: " + named.error().message);
    return published;
  }
  std::int64_t outside = 0;
  for (const HorizonChain& chain : chains) {
    for (std::size_t i = 0; i + 1 < chain.posts.size(); ++i) {
      const auto inside = [&dem](const std::array<std::int32_t, 2>& p) {
        return p[0] >= 0 && p[0] < dem.columns && p[1] >= 0 && p[1] < dem.rows;
      };
      if (!inside(chain.posts[i]) || !inside(chain.posts[i + 1]) ||
          chain.posts[i] == chain.posts[i + 1]) {
        ++outside;
        continue;
      }
      const auto post = [&](std::size_t k) {
        return chain.posts[k][1] * dem.columns + chain.posts[k][0];
      };
      published.edges.push_back(MakeEdge(post(i), post(i + 1)));
      published.level_kept.push_back(chain.level_kept[i].value_or(-1));
      published.undecided += chain.undecided ? 1 : 0;
    }
  }
  claims.Same("horizon.geojson edges that join no two posts", std::int64_t{0}, outside);
  const std::vector<HorizonChain> expected = ChainsOf(found);
  const ChainRounding rounding = RoundingOfChains(
      std::min(input.georeference().column_step_m(), input.georeference().row_step_m()));
  claims.Same("horizon.geojson chains", chains.size(), expected.size());
  std::int64_t others = 0;
  std::int64_t misplaced = 0;
  std::int64_t different = 0;
  for (std::size_t i = 0; i < std::min(chains.size(), expected.size()); ++i) {
    others += chains[i].posts == expected[i].posts ? 0 : 1;
    misplaced += Near(chains[i].line, expected[i].line, rounding) ? 0 : 1;
    different += SameWeights(chains[i], expected[i]) ? 0 : 1;
  }
  claims.Same("horizon.geojson chains of other posts", std::int64_t{0}, others);
  claims.Same("horizon.geojson chains that are not where their posts are", std::int64_t{0},
              misplaced);
  claims.Same("horizon.geojson chains with other azimuths or weights, or context", std::int64_t{0},
              different);
  return published;
}

}  // namespace farhorizon
