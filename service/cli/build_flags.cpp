#include "service/cli/build_flags.h"

#include <algorithm>
#include <thread>
#include <vector>

namespace farhorizon {

namespace {

// Adds the flag of `parameter`.
void Add(Command& command, BuildFlags& flags, const char* parameter, const char* type,
         const char* help) {
  command.Add(
      {.names = FlagOf(parameter), .type = type, .help = help},
      [&flags, parameter](const std::string& value) { flags.parameters[parameter] = value; });
}

// Likewise, for one that may be given more than once; commas separate the values of the parameter.
void AddList(Command& command, BuildFlags& flags, const char* parameter, const char* type,
             const char* help) {
  command.AddList({.names = FlagOf(parameter), .type = type, .help = help},
                  [&flags, parameter](const std::vector<std::string>& values) {
                    std::string joined;
                    for (const std::string& value : values) joined.append(",").append(value);
                    flags.parameters[parameter] = joined.substr(1);
                  });
}

}  // namespace

Result<BuildOptions> BuildFlags::Options() const {
  Result<BuildOptions> options = ParseOptions(parameters);
  if (!options) return options;
  const int cores = static_cast<int>(std::thread::hardware_concurrency());
  options->threads = threads > 0 ? threads : std::max(1, cores);
  Status checked = CheckOptions(*options);
  if (!checked) return std::move(checked.error());
  return options;
}

void AddBuildFlags(Command& command, BuildFlags& flags) {
  Add(command, flags, "levels", "N",
      "number of levels of detail, 1 to 12; level 0 is the finest, each further one has 2/5 of the "
      "triangles of the one before; fewer where the next would have less than 500 (5)");
  Add(command, flags, "maxError", "M",
      "vertical error that level 0 may have at a post, metres (the lesser of an eighth of the cell "
      "size and a 64th of the relief, but what the heights and the encoding can tell)");
  Add(command, flags, "silhouetteError", "M",
      "by how much level 0 may rise above the skyline, metres; it keeps every horizon edge in "
      "either "
      "case (0)");
  AddList(
      command, flags, "triangles", "A,B,...",
      "instead of the three above: a level for each number, with at most that many triangles, in "
      "any order; exact where every horizon edge fits in");
  Add(command, flags, "formats", "a,b,...",
      "of 3dtiles, drc, geojson, flatgeobuf, geopackage, quantized-mesh (3dtiles,drc,geojson)");
  Add(command, flags, "skirt", "auto|M",
      "depth of the walls at the tile's sides and around holes, metres; 0: none (auto: the errors "
      "of the level and of the coarsest one, and the relief)");
  Add(command, flags, "horizonDetail", "HOW",
      "what horizon.geojson has: chains: edges one behind the other as lines; edges: every edge "
      "with all that is known of it, some five times the bytes (chains)");
  Add(command, flags, "edges", "WHERE",
      "where each level's horizon is drawn: lines: a file of its own, lodN-horizon.glb; inline: in "
      "lodN.glb, as EXT_mesh_primitive_edge_visibility; both; none (lines)");
  Add(command, flags, "tileTriangles", "N",
      "a level of more triangles is cut into parts of so many in the mean, lodN-X-Y.glb, so that a "
      "look at a corner fetches a corner; 0: none is (20000)");
  AddTileFlags(command, flags);
  command.AddSwitch(
      "--horizon-context",
      "say of each horizon edge whether it is one with the apron's ground too (context)",
      [&flags] { flags.parameters["horizonContext"] = "true"; });
  AddReadFlags(command, flags);
  AddWorkFlags(command, flags);
}

void AddTileFlags(Command& command, BuildFlags& flags) {
  Add(command, flags, "frame", "tile|LON,LAT|globe",
      "axes that positions are rounded along: the tile's own east, north and up, those at a place, "
      "or earth-fixed ones; tiles of one frame share posts bit for bit (tile)");
  Add(command, flags, "apron", "N",
      "the N outermost rows and columns on each side are the neighbours' ground: they give normals "
      "and are not meshed (0)");
}

void AddReadFlags(Command& command, BuildFlags& flags) {
  Add(command, flags, "crs", "CRS", "reference system, instead of the file's");
  Add(command, flags, "verticalDatum", "CRS",
      "vertical reference system, instead of the file's: a code, a datum's name such as EGM96, or "
      "ellipsoid");
  Add(command, flags, "heightUnit", "U",
      "m, ft or us-ft: unit of the heights, instead of the file's");
  Add(command, flags, "datumOperation", "OP",
      "way from the reference system's datum to WGS 84: a code or a name of PROJ's operations, or "
      "ballpark (one for a system, which is said)");
  AddList(command, flags, "nodata", "H",
          "height that stands for no data, beside the file's own: a number, nan or -inf; may be "
          "given more than once");
}

void AddWorkFlags(Command& command, BuildFlags& flags) {
  Add(command, flags, "workBudget", "N",
      "decisions about edges after which to give up (2000 for each edge of the terrain, at least a "
      "billion)");
  command.AddSwitch(
      "--approximate",
      "where the work budget does not suffice, keep what is undecided, marked as such",
      [&flags] { flags.parameters["approximate"] = "true"; });
}

void AddThreads(Command& command, BuildFlags& flags) {
  command.Add({.names = "--threads",
               .type = "N",
               .help = "threads to work with; never changes a byte of the result (all cores)"},
              flags.threads, 1, 1024);
}

}  // namespace farhorizon
