#pragma once

#include <cstdint>
#include <functional>
#include <random>
#include <string>
#include <vector>

#include "core/terrain/dem.h"
#include "core/terrain/mesh.h"

namespace farhorizon {

/// A rows x columns DEM with the height of each post from its column and row.
Dem MakeDem(std::int32_t columns, std::int32_t rows,
            const std::function<std::int32_t(std::int32_t, std::int32_t)>& height);

/// A terrain whose horizon is known.
struct NamedTerrain {
  std::string name;
  Dem dem;
  int horizon_edges = 0;  ///< -1: known only in part
};

/// The oracles O1 to O7 that fit a grid; see the tests of the brute force for where the counts are
/// from.
std::vector<NamedTerrain> NamedTerrains();

Dem Crater(bool west, bool south, bool east);  ///< O2, O3: notches of height 2 in the rim
Dem Paraboloid(std::int32_t n, int sign);      ///< O5 (sign 1), O6 (sign -1), n x n, n odd

/// What a random terrain is like.
struct RandomTerrain {
  std::int32_t columns = 5;
  std::int32_t rows = 5;
  std::int32_t max_height = 3;  ///< heights are 0 ... max_height
  int hole_percent = 0;         ///< share of posts without data
  int plateaus = 0;             ///< rectangles of one height laid over the rest
  int planes = 0;               ///< rectangles of posts in one plane laid over the rest
};
Dem RandomDem(const RandomTerrain& kind, std::mt19937& random);

/// A random kind of random terrain: sizes min_side ... max_side, low and high relief, with and
/// without holes, plateaus and planes.
Dem AnyRandomDem(std::int32_t min_side, std::int32_t max_side, std::mt19937& random);

/// Mountains by midpoint displacement: n x n posts, heights of about 0 ... relief; the roughness
/// halves with the distance between posts (H = 1) times roughness_percent / 100.
Dem FractalDem(std::int32_t n, std::int32_t relief, int roughness_percent, std::uint32_t seed);

/// Ground of a kind that is found outdoors, min_side ... max_side posts a side: mountains smooth
/// and rough, low and high; ridges; terraces, with their ties; lakes of no data; a coast; cones. No
/// white noise.
Dem AnyLandscape(std::int32_t min_side, std::int32_t max_side, std::mt19937& random);

/// A map of the plan that takes the triangulated grid to itself: (x, y) -> (xx x + xy y, yx x + yy
/// y). There are twelve, products of kTurnSixth and kTranspose.
struct GridMap {
  std::int32_t xx = 1;
  std::int32_t xy = 0;
  std::int32_t yx = 0;
  std::int32_t yy = 1;
};
inline constexpr GridMap kTurnSixth{1, -1, 1, 0};
inline constexpr GridMap kTranspose{0, 1, 1, 0};
GridMap operator*(const GridMap& second, const GridMap& first);
std::vector<GridMap> AllGridMaps();

/// `dem` with its posts where `map` takes them, the rest of the new grid without data.
struct MappedDem {
  Dem dem;
  std::vector<VertexId> image;  ///< by old post
};
MappedDem MapDem(const Dem& dem, const GridMap& map);

/// Heights h -> factor h + offset.
Dem MapHeights(Dem dem, std::int32_t factor, std::int32_t offset);

/// `edges` by the posts' images, sorted.
std::vector<Edge> MapEdges(const std::vector<Edge>& edges, const std::vector<VertexId>& image);

}  // namespace farhorizon
