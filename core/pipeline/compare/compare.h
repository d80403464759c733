#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "core/base/result.h"
#include "core/base/run_control.h"
#include "core/measure/mesh_error.h"
#include "core/pipeline/build_options.h"
#include "core/pipeline/compare/choose_placing.h"
#include "core/pipeline/report.h"

namespace farhorizon {

/// What is said of a mesh, or of one content of a tileset.
///
/// name: the file's, or the content's uri. depth, geometric_error_m: of the tile, as the tileset
/// has them. fault: why it could not be measured; all below is 0 then.
struct MeshComparison {
  std::string name;
  std::optional<int> depth;
  std::optional<double> geometric_error_m;
  std::optional<std::string> fault;

  std::int64_t triangles = 0;
  std::int64_t vertices = 0;
  std::string placing;          ///< how its coordinates were read, and whether that is assumed
  std::int64_t posts = 0;       ///< of the DEM, that it covers
  double covered_share = 0;     ///< those, of all that have data
  bool in_part = false;         ///< it was measured against the covered posts alone
  std::int64_t hole_posts = 0;  ///< that it leaves out within what it covers
  std::int64_t posts_without_data = 0;  ///< that it covers although the DEM has nothing there
  double mean_error_m = 0;              ///< of mesh less DEM, at the posts
  double correlation = 0;               ///< of its heights with the DEM's
  std::int64_t skirt_triangles = 0;     ///< upright ones, which were left out
  std::int64_t polygons = 0;            ///< faces that were cut into triangles
  bool turned = false;                  ///< its triangles were clockwise seen from above
  MeshError error;

  /// Whether it is no sound surface: flipped triangles, triangles over one another, holes.
  [[nodiscard]] bool IsUnsound() const {
    const MeshDefects& defects = error.defects;
    return defects.flipped > 0 || defects.crowded_edges > 0 || defects.covered_twice > 0 ||
           hole_posts > 0;
  }
};

/// A mesh file compared with a DEM.
struct Comparison {
  std::string dem_name;
  DemReport dem;
  Assumptions assumptions;  ///< of the DEM, then of the mesh
  std::vector<MeshComparison> meshes;
  std::string picture;  ///< SVG of the first one that was measured; empty where not asked for
};

struct CompareOptions {
  StatedPlacing placing = {};
  std::optional<std::string> tile = {};  ///< of a tileset: only the content with this uri
  bool picture = false;
};

/// Measures `mesh`, a file of anyone, against `dem`: a GLB, glTF, Draco mesh, OBJ, PLY or STL, or
/// every content of a tileset.
///
/// build: how to read the DEM and to find its horizon, as TerrainInput::Open and FindHorizon have
/// it. A mesh that covers the DEM in part is measured against that part (PartUnder).
/// Errors: those of TerrainInput::Open and FindHorizon; for a single mesh those of ReadMesh,
///   ChoosePlacing, HeightsOverPosts, CheckHeights and MeshMeasurer::Measure; for a tileset those
///   of ReadTiles, the first fault where no content can be measured, and kNotFound, kind
///   "no-such-file", where none has the uri of options.tile.
Result<Comparison> CompareMesh(const std::filesystem::path& dem, const std::filesystem::path& mesh,
                               const CompareOptions& options, const BuildOptions& build,
                               const RunControl& control);

}  // namespace farhorizon
