// One mesh: read, placed on the grid, tidied, held to the DEM's heights, measured. A tileset: each
// of its contents so. A mesh that covers the DEM in part is measured against that part, whose
// horizon is found anew: ground beyond it is no fault of the mesh.
#include "core/pipeline/compare/compare.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <utility>

#include "core/horizon/find_horizon.h"
#include "core/io/mesh_files/read_mesh.h"
#include "core/io/mesh_files/tileset_tiles.h"
#include "core/pipeline/compare/comparison_text.h"
#include "core/pipeline/compare/covered_part.h"
#include "core/pipeline/compare/draw_comparison.h"
#include "core/pipeline/compare/mesh_places.h"
#include "core/pipeline/compare/prepared_mesh.h"
#include "core/pipeline/terrain_input.h"

namespace farhorizon {

namespace {

namespace fs = std::filesystem;

// A mesh of a DEM needs two triangles a post; soups name each corner by itself.
MeshLimits LimitsFor(const Dem& dem) {
  constexpr std::size_t kTrianglesAPost = 8;
  constexpr std::size_t kAlways = std::size_t{1} << 20U;
  MeshLimits limits;
  limits.max_triangles = std::max(kAlways, kTrianglesAPost * dem.heights.size());
  limits.max_points = 3 * limits.max_triangles;
  // Text of STL takes some 300 bytes a triangle; a GLB may have a texture.
  constexpr std::uintmax_t kBytesATriangle = 512;
  constexpr std::uintmax_t kBytesBeside = std::uintmax_t{256} << 20U;
  limits.max_bytes =
      std::min(limits.max_bytes, kBytesBeside + kBytesATriangle * limits.max_triangles);
  return limits;
}

// Measures meshes of one DEM; the whole DEM's horizon is found once.
class Comparer {
 public:
  Comparer(const TerrainInput& input, std::string name, const CompareOptions& options,
           const BuildOptions& build)
      : input_(input),
        input_name_(std::move(name)),
        options_(options),
        build_(build),
        places_(input) {}

  Result<MeshComparison> Compare(const FileMesh& file, MeshComparison about, Comparison& whole,
                                 const RunControl& control) {
    Result<PreparedMesh> prepared = PrepareMesh(file, options_.placing, input_, about, control);
    if (!prepared) return std::move(prepared.error());
    if (prepared->assumed) Assume("mesh-frame", about.placing, whole.assumptions, control);
    const std::optional<CoveredPart> part = PartUnder(prepared->heights, input_.dem());
    about.in_part = part.has_value();
    std::optional<Terrain> part_terrain;
    if (part) {
      MoveInto(*part, prepared->mesh.grid);
      Result<Terrain> terrain = Terrain::Build(part->dem);
      if (!terrain) {
        return std::move(terrain.error()).WithContext("the part of the DEM under the mesh");
      }
      part_terrain = *terrain;
    }
    const Terrain& terrain = part_terrain ? *part_terrain : input_.terrain();
    std::optional<Horizon> part_horizon;
    if (part || !horizon_) {
      Result<Horizon> horizon = FindHorizon(terrain, HorizonOptionsOf(build_), control);
      if (!horizon) return std::move(horizon.error());
      (part ? part_horizon : horizon_) = *std::move(horizon);
    }
    const Horizon& horizon = part ? *part_horizon : *horizon_;
    Result<PostPlaces> places = places_.For(prepared->placing.frame, part ? &*part : nullptr);
    if (!places) return std::move(places.error());
    std::optional<MeshMeasurer> of_part;
    std::optional<MeshMeasurer>& measurer =
        part ? of_part : measurers_[IsStraightOnGlobe(prepared->placing.frame) ? 1 : 0];
    if (!measurer) measurer.emplace(terrain, horizon, *places);
    Result<MeshError> error = measurer->Measure(prepared->mesh, control);
    if (!error) return std::move(error.error());
    about.error = *std::move(error);
    if (options_.picture && whole.picture.empty()) {
      Result<std::string> picture =
          DrawComparison({input_, terrain, horizon, prepared->mesh, *places,
                          about.name + " against " + input_name_, PictureLines(about)});
      if (!picture) return std::move(picture.error());
      whole.picture = *std::move(picture);
    }
    return about;
  }

 private:
  static void Assume(const std::string& code, const std::string& text, Assumptions& assumptions,
                     const RunControl& control) {
    const bool known = std::ranges::any_of(
        assumptions, [&](const Assumption& a) { return a.code == code && a.text == text; });
    if (known) return;
    assumptions.push_back({code, text});
    control.Assume(assumptions.back());
  }

  const TerrainInput& input_;
  std::string input_name_;
  const CompareOptions& options_;
  const BuildOptions& build_;
  MeshPlaces places_;
  std::optional<Horizon> horizon_;
  std::array<std::optional<MeshMeasurer>, 2> measurers_;  // of the whole DEM; straight on the globe
};

// The content of a tile in the axes of the tileset: earth-fixed, or unplaced where it is near the
// origin.
Result<FileMesh> ReadTile(const TileContent& tile, const MeshLimits& limits) {
  constexpr double kDeepestGround = 6.3e6;  // metres from the earth's centre
  Result<FileMesh> mesh = ReadMesh(tile.file, limits);
  if (!mesh) return mesh;
  Place(tile.placing, *mesh);
  const FilePoint& p = mesh->points.front();
  const bool far = std::hypot(p[0], p[1], p[2]) > kDeepestGround;
  mesh->frame = far ? FileFrame::kEcef : FileFrame::kUnstated;
  return mesh;
}

Status CompareTiles(const fs::path& file, Comparer& comparer, const CompareOptions& options,
                    const MeshLimits& limits, Comparison& result, const RunControl& control) {
  Result<std::vector<TileContent>> tiles = ReadTiles(file);
  if (!tiles) return std::move(tiles.error()).WithContext(file.filename().string());
  if (options.tile) {
    std::erase_if(*tiles, [&](const TileContent& tile) { return tile.uri != *options.tile; });
    if (tiles->empty()) {
      return Error{ErrorCode::kNotFound, "the tileset has no content \"" + *options.tile + "\"",
                   "no-such-file"};
    }
  }
  std::optional<Error> first;
  bool measured = false;
  for (std::size_t i = 0; i < tiles->size(); ++i) {
    const TileContent& tile = (*tiles)[i];
    const double share = 1.0 / static_cast<double>(tiles->size());
    const RunControl piece =
        control.Between(static_cast<double>(i) * share, static_cast<double>(i + 1) * share);
    MeshComparison about;
    about.name = tile.uri;
    about.depth = tile.depth;
    about.geometric_error_m = tile.geometric_error_m;
    Result<FileMesh> mesh = ReadTile(tile, limits);
    Result<MeshComparison> row =
        mesh ? comparer.Compare(*mesh, about, result, piece) : std::move(mesh.error());
    if (!row && row.error().code == ErrorCode::kCancelled) return std::move(row.error());
    if (!row) {
      about.fault = row.error().message;
      if (!first) first = std::move(row.error()).WithContext(tile.uri);
    }
    measured = measured || row.has_value();
    result.meshes.push_back(row ? *std::move(row) : about);
  }
  if (!measured) return *std::move(first);
  return Ok{};
}

}  // namespace

Result<Comparison> CompareMesh(const fs::path& dem, const fs::path& mesh,
                               const CompareOptions& options, const BuildOptions& build,
                               const RunControl& control) {
  control.Report(Stage::kRead, 0);
  Result<MeshFormat> format = MeshFormatOf(mesh);
  if (!format) return std::move(format.error());
  Result<std::unique_ptr<TerrainInput>> input = TerrainInput::Open(dem, build, control);
  if (!input) return std::move(input.error());
  Comparison result;
  result.dem_name = dem.filename().string();
  result.dem = (*input)->report();
  result.assumptions = (*input)->assumptions();
  Comparer comparer(**input, result.dem_name, options, build);
  const MeshLimits limits = LimitsFor((*input)->dem());
  if (*format == MeshFormat::kTileset) {
    control.Report(Stage::kRead, 1);
    if (Status tiles = CompareTiles(mesh, comparer, options, limits, result, control); !tiles) {
      return std::move(tiles.error());
    }
    return result;
  }
  Result<FileMesh> file = ReadMesh(mesh, limits);
  if (!file) return std::move(file.error());
  control.Report(Stage::kRead, 1);
  MeshComparison about;
  about.name = mesh.filename().string();
  Result<MeshComparison> row = comparer.Compare(*file, about, result, control);
  if (!row) return std::move(row.error());
  result.meshes.push_back(*std::move(row));
  return result;
}

}  // namespace farhorizon
