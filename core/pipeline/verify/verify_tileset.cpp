#include "core/pipeline/verify/verify_tileset.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "core/io/file.h"
#include "core/io/tileset_reader.h"

namespace farhorizon {

namespace {

// Far above what another build's arithmetic does to radians and metres, far below any rounding of
// vertices.
constexpr double kSameRadians = 1e-11;
constexpr double kSameM = 1e-4;

bool IsSame(const BoundingRegion& a, const BoundingRegion& b) {
  const double turned = std::max({std::abs(a.west - b.west), std::abs(a.south - b.south),
                                  std::abs(a.east - b.east), std::abs(a.north - b.north)});
  const double raised = std::max(std::abs(a.min_height_m - b.min_height_m),
                                 std::abs(a.max_height_m - b.max_height_m));
  return turned < kSameRadians && raised < kSameM;
}

// What of two trees is the same.
struct Sameness {
  bool tiles = true;
  bool errors = true;
  bool regions = true;
};

void Compare(const TilesetTile& a, const TilesetTile& b, Sameness& same) {
  same.tiles = same.tiles && a.uri == b.uri && a.children.size() == b.children.size();
  same.errors = same.errors && a.geometric_error_m == b.geometric_error_m;
  same.regions = same.regions && IsSame(a.region, b.region);
  for (std::size_t i = 0; same.tiles && i < a.children.size(); ++i) {
    Compare(a.children[i], b.children[i], same);
  }
}

}  // namespace

bool PlacesFrame(const std::array<double, 16>& transform, const TerrainInput& input) {
  const std::array<double, 16> due = input.georeference().frame().EnuToEcef();
  double off = 0;
  for (std::size_t i = 0; i < 16; ++i) off = std::max(off, std::abs(transform[i] - due[i]));
  // Far above what writing a double rounds, far below any rounding of vertices.
  return off < 1e-6;
}

void VerifyTileset(const TerrainInput& input, const std::filesystem::path& directory,
                   const std::vector<LevelReport>& levels,
                   const std::vector<std::vector<TileContentRegion>>& contents, Claims& claims) {
  const auto has_glb = [](const LevelReport& level) { return level.glb_bytes > 0; };
  if (std::ranges::none_of(levels, has_glb)) return;
  Result<std::string> text = ReadFile(directory / "tileset.json");
  if (!text) {
    claims.Add(false, "tileset.json: " + text.error().message);
    return;
  }
  Result<TilesetContents> tileset = ReadTileset(*text);
  claims.Add(tileset.has_value(), "tileset.json is a tileset with explicit tiling" +
                                      (tileset ? "" : ": " + tileset.error().message));
  if (!tileset) return;
  claims.Add(PlacesFrame(tileset->transform, input),
             "tileset.json places the local frame where the DEM is");
  const bool all_read = std::ranges::none_of(contents, &std::vector<TileContentRegion>::empty);
  claims.Add(all_read, "tileset.json has levels whose GLBs can be read");
  if (!all_read) return;
  Sameness same;
  Compare(tileset->root, TreeOf(levels, contents, tileset->root_error_m), same);
  claims.Add(same.tiles,
             "tileset.json has each GLB once, below that of the ground that it refines");
  claims.Add(same.errors, "tileset.json has the measured geometric errors");
  claims.Add(same.regions, "tileset.json has regions that hold what is in them, and no more");
}

}  // namespace farhorizon
