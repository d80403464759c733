#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/result.h"
#include "core/geo/frame_choice.h"
#include "core/horizon/find_horizon.h"

namespace farhorizon {

/// Where a level's horizon edges are drawn: in a file of lines, lodN-horizon.glb; in the GLB of its
/// mesh, as EXT_mesh_primitive_edge_visibility; in both; nowhere.
enum class EdgeFiles { kLines, kInline, kBoth, kNone };
inline bool HasLines(EdgeFiles edges) {
  return edges == EdgeFiles::kLines || edges == EdgeFiles::kBoth;
}
inline bool IsInline(EdgeFiles edges) {
  return edges == EdgeFiles::kInline || edges == EdgeFiles::kBoth;
}

/// What horizon.geojson has: lines of edges one behind the other, or every edge with all that is
/// known of it.
enum class HorizonDetail { kChains, kEdges };

/// Options of `farhorizon build` and of a job. The defaults are those of proto/openapi.yaml.
struct BuildOptions {
  int levels = 5;                     ///< at most
  std::optional<double> max_error_m;  ///< of level 0; unset: as LevelPlan has it
  double silhouette_error_m = 0;      ///< by how much level 0 may rise above the skyline
  /// For each level the most triangles that it may have, falling, instead of the three above; empty
  /// where those say what the levels are.
  std::vector<std::int64_t> triangles;
  std::vector<std::string> formats = {"3dtiles", "drc", "geojson"};
  std::optional<std::string> crs;
  std::optional<std::string> vertical_datum;
  std::optional<std::string> height_unit;      ///< "m", "ft" or "us-ft"
  std::optional<std::string> datum_operation;  ///< as GlobeTransform has it
  std::vector<double> nodata;                  ///< beside the file's own
  std::int64_t max_posts = 64'000'000;
  /// As HorizonOptions has it: decisions about candidates.
  std::optional<std::int64_t> work_budget;
  bool approximate = false;  ///< as HorizonOptions has it
  EdgeFiles edges = EdgeFiles::kLines;
  HorizonDetail horizon_detail = HorizonDetail::kChains;
  /// How deep skirts are, metres; 0: none; unset: as SkirtDepths has it.
  std::optional<double> skirt_m;
  FrameChoice frame = {};  ///< whose axes the lattice has
  /// Rows and columns on each side that are the neighbours' ground: for normals, not meshed.
  int apron = 0;
  bool horizon_context = false;  ///< whether the apron's ground is asked about the horizon too
  /// Levels of more triangles are cut into parts of so many in the mean; 0: none is.
  std::int64_t tile_triangles = 20'000;
  int threads = 1;  ///< never changes a byte of the result
};

/// Whether a format is asked for.
bool Asks(const BuildOptions& options, std::string_view format);

/// Checks options that need no DEM to be checked. Errors: kInvalidArgument, naming the flag, its
/// value and its range.
Status CheckOptions(const BuildOptions& options);

/// The names of all parameters that a job may have, as in proto/openapi.yaml: "maxError".
std::vector<std::string_view> ParameterNames();
/// The flag of the command line for a parameter: "--max-error" of "maxError". Messages of the core
/// name flags.
std::string FlagOf(std::string_view parameter);

/// Reads options from a job's parameters, by name, and checks them. Values are text: whole numbers
/// may be written 3.0 or 3e0; the several values of `nodata` are separated by commas, each a
/// number, inf, -inf or nan, those of `triangles` likewise, each a whole number, in any order.
/// Errors: kInvalidArgument, kind "unknown-parameter" or "invalid-parameter", the latter also where
///   `triangles` comes with a parameter that it takes the place of; those of CheckOptions.
Result<BuildOptions> ParseOptions(const std::map<std::string, std::string>& parameters);

/// The options of FindHorizon for a build: where the work budget is short, half of it is for what
/// is said of the edges.
HorizonOptions HorizonOptionsOf(const BuildOptions& options);

}  // namespace farhorizon
