// A DEM becomes a tileset: read, find the horizon, simplify, encode, measure, write. Each step is a
// function of its own file; this one has their order and decides which artifacts are written.
#include "core/pipeline/build.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <string_view>
#include <utility>

#include "core/horizon/find_horizon.h"
#include "core/io/horizon_chains.h"
#include "core/io/horizon_features.h"
#include "core/io/horizon_glb.h"
#include "core/io/horizon_vector.h"
#include "core/io/line_chains.h"
#include "core/io/tileset.h"
#include "core/pipeline/artifact_writer.h"
#include "core/pipeline/build_features.h"
#include "core/pipeline/level_artifact.h"
#include "core/pipeline/level_edges.h"
#include "core/pipeline/level_plan.h"
#include "core/pipeline/mesh_region.h"
#include "core/pipeline/post_places.h"
#include "core/pipeline/report.h"
#include "core/pipeline/report_page/report_page.h"
#include "core/pipeline/skirt.h"
#include "core/pipeline/terrain_input.h"
#include "core/pipeline/terrain_tiles/terrain_tiles.h"
#include "core/pipeline/version.h"

namespace farhorizon {

namespace {

namespace fs = std::filesystem;

// The share of a level's part of Stage::kEncode after which its skyline is looked for.
constexpr double kEncoded = 0.3;

bool Asks(const BuildOptions& options, std::string_view format) {
  return std::find(options.formats.begin(), options.formats.end(), format) != options.formats.end();
}

std::string_view AsText(const std::vector<std::uint8_t>& bytes) {
  return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

// For each horizon edge the coarsest level that keeps it, -1 for none.
std::vector<int> LevelsKept(const Horizon& horizon, const std::vector<Lod>& chain) {
  std::vector<int> level_kept(horizon.edges.size(), -1);
  for (std::size_t level = 0; level < chain.size(); ++level) {
    for (const std::int32_t i : chain[level].kept) {
      level_kept[static_cast<std::size_t>(i)] = static_cast<int>(level);
    }
  }
  return level_kept;
}

// The levels as they were written, and what they cover. globe: for the tiles of quantized-mesh, if
// these are asked for.
struct WrittenLevels {
  std::vector<LevelReport> reports;
  std::vector<LevelEdges> edges;  // where they are asked for
  MeshRegion region;
  std::vector<TiledLevel> globe;
};

// The levels' region, with the terrain's heights and room for what the coarsest level may add.
Result<BoundingRegion> RegionOf(const TerrainInput& input, const WrittenLevels& levels) {
  const LevelReport& coarsest = levels.reports.back();
  BoundingRegion region = levels.region.Sides(coarsest.side_step_m);
  Result<std::array<double, 2>> heights = input.EllipsoidalHeights();
  if (!heights) return std::move(heights.error());
  // Flat triangles sink below the curved earth, and vertices are rounded: by no more than this.
  const double margin = coarsest.geometric_error_m + coarsest.side_step_m;
  const double deepest_m = std::ranges::max(levels.reports, {}, &LevelReport::skirt_m).skirt_m;
  region.min_height_m = (*heights)[0] - margin - deepest_m;
  region.max_height_m = (*heights)[1] + margin;
  return region;
}

Status WriteTilesetFor(const TerrainInput& input, const WrittenLevels& levels,
                       ArtifactWriter& writer) {
  Result<BoundingRegion> region = RegionOf(input, levels);
  if (!region) return std::move(region.error());
  std::vector<TilesetLevel> tiles;
  tiles.reserve(levels.reports.size());
  for (const LevelReport& level : levels.reports) {
    tiles.push_back({"lod" + std::to_string(level.level) + ".glb", level.geometric_error_m});
  }
  const Georeference& georeference = input.georeference();
  const double size_m = std::hypot(georeference.column_step_m() * (input.dem().columns - 1),
                                   georeference.row_step_m() * (input.dem().rows - 1));
  return writer.Add("tileset.json", WriteTileset(tiles, *region, RoundUp(size_m),
                                                 georeference.frame().EnuToEcef()));
}

// Writes lodN-horizon.glb for each level, with what is known of the DEM's edges by now.
Status WriteEdges(const std::vector<HorizonFeature>& features, WrittenLevels& levels,
                  ArtifactWriter& writer) {
  for (std::size_t i = 0; i < levels.edges.size(); ++i) {
    LevelEdges& edges = levels.edges[i];
    AddMeasures(features, edges);
    const std::vector<std::uint8_t> glb = WriteHorizonGlb(LineChainsOf(edges.lines), edges.lattice);
    levels.reports[i].skyline_edges.bytes = std::ssize(glb);
    Status added = writer.Add(HorizonGlbName(static_cast<int>(i)), AsText(glb));
    if (!added) return added;
  }
  return Ok{};
}

Status WriteFeatures(const std::vector<HorizonFeature>& features, const Georeference& georeference,
                     const BuildOptions& options, ArtifactWriter& writer) {
  if (Asks(options, "geojson")) {
    const double cell_m = std::min(georeference.column_step_m(), georeference.row_step_m());
    Status added =
        writer.Add("horizon.geojson", options.horizon_detail == HorizonDetail::kEdges
                                          ? WriteHorizonGeoJson(features)
                                          : WriteHorizonChains(ChainsOf(features), cell_m));
    if (!added) return added;
  }
  for (const auto& [format, name] :
       {std::pair{"flatgeobuf", "horizon.fgb"}, {"geopackage", "horizon.gpkg"}}) {
    if (!Asks(options, format)) continue;
    Status written = WriteHorizonVector(features, writer.PathOf(name));
    if (!written) return written;
    if (Status added = writer.AddWritten(name); !added) return added;
  }
  return Ok{};
}

// What level i was asked for: by size, every further level two fifths of the triangles of the one
// before it.
LevelAsked AskedOf(const LevelPlan& plan, const std::vector<Lod>& chain, std::size_t i) {
  if (!plan.lods.triangles.empty()) return {.triangles = plan.lods.triangles[i]};
  if (i > 0) return {.triangles = std::ssize(chain[i - 1].mesh.triangles) * 2 / 5};
  return {.vertical_m = plan.max_error_m, .silhouette_m = plan.lods.silhouette_error_m};
}

// Writes the files of the levels that are asked for; by now all are measured, as skirts need it.
Status WriteFiles(const LevelContext& context, const TerrainInput& input,
                  const BuildOptions& options, std::vector<LevelArtifact>& levels,
                  ArtifactWriter& writer, WrittenLevels& written) {
  const std::vector<double> depths = SkirtDepths(input, written.reports, options.skirt_m);
  for (std::size_t i = 0; i < levels.size(); ++i) {
    LevelArtifact& level = levels[i];
    level.report = written.reports[i];
    const std::string name = "lod" + std::to_string(i);
    if (!level.glb_stream.empty()) {
      LocalMesh skirt;
      Result<std::vector<std::uint8_t>> glb = LevelGlb(context, depths[i], level, skirt);
      if (!glb) return std::move(glb.error()).WithContext("level " + std::to_string(i));
      if (Status added = writer.Add(name + ".glb", AsText(*glb)); !added) return added;
      if (Status added = written.region.Add(skirt); !added) return added;
    }
    if (!level.drc.empty()) {
      if (Status added = writer.Add(name + ".drc", AsText(level.drc)); !added) return added;
    }
    written.reports[i] = level.report;
    if (Asks(options, "quantized-mesh")) {
      Result<GlobeMesh> globe = PlaceOnGlobe(context.georeference, level.decoded.mesh);
      if (!globe) return std::move(globe.error());
      written.globe.push_back({*std::move(globe), level.report.geometric_error_m});
    }
    level = {};
  }
  return Ok{};
}

Result<WrittenLevels> WriteLevels(const LevelContext& context, const TerrainInput& input,
                                  const LevelPlan& plan, const std::vector<Lod>& chain,
                                  const BuildOptions& options, ArtifactWriter& writer,
                                  ReportPage& page) {
  WrittenLevels written = {{}, {}, MeshRegion(context.georeference), {}};
  std::vector<LevelArtifact> levels;
  std::vector<LevelReport>& reports = written.reports;
  std::vector<PlacedMesh> decoded;
  for (std::size_t i = 0; i < chain.size(); ++i) {
    const RunControl control = LevelControl(context.control, i, chain.size());
    const bool glb = Asks(options, "3dtiles");
    const LevelStorage storage = {plan.finest_side_m, CoarsenessOf(plan, context.terrain.dem(), i),
                                  glb ? MostSkirtDepth(input, options.skirt_m) : 0, glb,
                                  Asks(options, "drc")};
    const RunControl encoding = control.Between(0, kEncoded);
    Result<LevelArtifact> level =
        EncodeLevel(context.With(encoding), chain[i], static_cast<int>(i), storage);
    if (!level) return std::move(level.error());
    level->report.asked = AskedOf(plan, chain, i);
    const LocalMesh& mesh = level->decoded.mesh;
    Result<PlacedMesh> placed = PlaceLevel(context, mesh);
    if (!placed) return std::move(placed.error()).WithContext("level " + std::to_string(i));
    decoded.push_back(*std::move(placed));
    if (glb && options.edges != EdgeFiles::kNone) {
      const RunControl searching = control.Between(kEncoded, 1);
      Result<LevelEdges> edges = FindLevelEdges(context.With(searching), chain[i].kept,
                                                {level->decoded, decoded.back()}, options.threads);
      if (!edges) return std::move(edges.error());
      level->report.skyline_edges = edges->report;
      if (IsInline(options.edges)) level->flagged = edges->vertices;
      written.edges.push_back(*std::move(edges));
    }
    control.Report(Stage::kEncode, 1);
    reports.push_back(level->report);
    if (Status added = written.region.Add(mesh); !added) return std::move(added.error());
    if (Status drawn = page.AddLevel(mesh); !drawn) return std::move(drawn.error());
    levels.push_back(*std::move(level));
  }
  Result<std::vector<MeshError>> errors =
      context.measurer.MeasureAll(decoded, options.threads, context.control);
  if (!errors) return std::move(errors.error());
  for (std::size_t i = 0; i < reports.size(); ++i) {
    ReportErrors((*errors)[i], reports[i]);
    // Clients refine towards smaller errors: no level may claim a smaller error than a finer one.
    if (i > 0) {
      reports[i].geometric_error_m =
          std::max(reports[i].geometric_error_m, reports[i - 1].geometric_error_m);
    }
  }
  Status files = WriteFiles(context, input, options, levels, writer, written);
  if (!files) return std::move(files.error());
  return written;
}

}  // namespace

Status BuildArtifacts(const fs::path& dem, const fs::path& directory, const BuildOptions& options,
                      const RunControl& control) {
  Status checked = CheckOptions(options);
  if (!checked) return checked;
  control.Report(Stage::kRead, 0);
  Result<std::unique_ptr<TerrainInput>> input = TerrainInput::Open(dem, options, control);
  if (!input) return std::move(input.error());
  if (Asks(options, "quantized-mesh")) {
    Status off_poles = CheckOffPoles((*input)->georeference(), (*input)->dem());
    if (!off_poles) return off_poles;
  }
  Result<LevelPlan> plan = PlanLevels(**input, options);
  if (!plan) return std::move(plan.error());
  control.Report(Stage::kRead, 1);

  const HorizonOptions horizon_options = HorizonOptionsOf(options);
  WorkBudget budget = WorkBudgetOf((*input)->terrain(), horizon_options);
  Result<Horizon> horizon = FindHorizon((*input)->terrain(), horizon_options, budget, control);
  if (!horizon) return std::move(horizon.error());

  Result<std::vector<Lod>> chain =
      BuildLodChain((*input)->terrain(), *horizon, plan->lods, control);
  if (!chain) return std::move(chain.error());

  control.Report(Stage::kEncode, 0);
  Result<PostNormals> normals =
      FindPostNormals((*input)->around(), (*input)->georeference(), (*input)->apron());
  if (!normals) return std::move(normals.error());
  ArtifactWriter writer(directory);
  Status opened = writer.Open();
  if (!opened) return opened;
  Result<PostPlaces> places = FindPostPlaces((*input)->terrain(), (*input)->georeference());
  if (!places) return std::move(places.error());
  MeshMeasurer measurer((*input)->terrain(), *horizon, *std::move(places));
  const LevelContext context{
      (*input)->terrain(), *horizon, (*input)->georeference(), *normals, measurer, control};
  Result<ReportPage> page =
      ReportPage::Start((*input)->terrain(), (*input)->georeference(), *horizon);
  if (!page) return std::move(page.error());
  Result<WrittenLevels> levels =
      WriteLevels(context, **input, *plan, *chain, options, writer, *page);
  if (!levels) return std::move(levels.error());
  if (Asks(options, "3dtiles")) {
    Status tileset = WriteTilesetFor(**input, *levels, writer);
    if (!tileset) return tileset;
  }
  if (!levels->globe.empty()) {
    control.Report(Stage::kWrite, 0);
    Status tiles = WriteTerrainTiles(std::exchange(levels->globe, {}), control,
                                     [&writer](const std::string& name, const std::string& bytes) {
                                       return writer.Add(name, bytes);
                                     });
    if (!tiles) return tiles;
  }
  Result<std::vector<HorizonFeature>> features =
      BuildFeatures(**input, *horizon, LevelsKept(*horizon, *chain),
                    {.budget = budget, .threads = options.threads}, control);
  if (!features) return std::move(features.error());
  control.Report(Stage::kWrite, 0);
  Status written = WriteFeatures(*features, (*input)->georeference(), options, writer);
  if (!written) return written;
  if (HasLines(options.edges)) {
    Status lines = WriteEdges(*features, *levels, writer);
    if (!lines) return lines;
  }
  const Report report{Version(),
                      (*input)->report(),
                      (*input)->assumptions(),
                      static_cast<std::int64_t>(horizon->edges.size()),
                      horizon->statistics,
                      levels->reports,
                      FrameReport{options.frame, (*input)->georeference().frame().EnuToEcef()}};
  Status reported = writer.Add("report.json", WriteReport(report));
  if (!reported) return reported;
  Result<std::string> html = page->Write({report, *features, writer.entries(), control.Timings()});
  if (!html) return std::move(html.error());
  Status shown = writer.Add("report.html", *html);
  if (!shown) return shown;
  Status finished = writer.Finish();
  control.Report(Stage::kWrite, 1);
  return finished;
}

}  // namespace farhorizon
