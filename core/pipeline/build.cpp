// A DEM becomes a tileset: read, find the horizon, simplify, encode, measure, write. Each step is a
// function of its own file; this one has their order and decides which artifacts are written.
#include "core/pipeline/build.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
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
#include "core/pipeline/horizon_context.h"
#include "core/pipeline/level_artifact.h"
#include "core/pipeline/level_plan.h"
#include "core/pipeline/post_places.h"
#include "core/pipeline/report.h"
#include "core/pipeline/report_page/report_page.h"
#include "core/pipeline/terrain_input.h"
#include "core/pipeline/terrain_tiles/terrain_tiles.h"
#include "core/pipeline/version.h"
#include "core/pipeline/write_levels.h"

namespace farhorizon {

namespace {

namespace fs = std::filesystem;

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

std::optional<std::int64_t> CountInContext(const BuildOptions& options, const EdgeFacts& facts) {
  if (!options.horizon_context) return std::nullopt;
  return std::ranges::count(facts.in_context, true);
}

Status WriteTilesetFor(const TerrainInput& input, const WrittenLevels& levels,
                       ArtifactWriter& writer) {
  const Georeference& georeference = input.georeference();
  const double size_m = RoundUp(std::hypot(georeference.column_step_m() * (input.dem().columns - 1),
                                           georeference.row_step_m() * (input.dem().rows - 1)));
  return writer.Add("tileset.json", WriteTileset(TreeOf(levels.reports, levels.contents, size_m),
                                                 size_m, georeference.frame().EnuToEcef()));
}

// Writes lodN-horizon.glb for each level, with what is known of the DEM's edges by now.
Status WriteEdges(const std::vector<HorizonFeature>& features, WrittenLevels& levels,
                  ArtifactWriter& writer) {
  for (std::size_t i = 0; i < levels.edges.size(); ++i) {
    LevelEdges& edges = levels.edges[i];
    AddMeasures(features, edges);
    const std::vector<std::uint8_t> glb = WriteHorizonGlb(LineChainsOf(edges.lines), edges.lattice);
    levels.reports[i].skyline_edges.bytes = std::ssize(glb);
    Status added = writer.Add(HorizonGlbName(static_cast<int>(i)), glb);
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
  Result<HorizonInContext> found =
      FindHorizonInContext(**input, options.horizon_context, horizon_options, budget, control);
  if (!found) return std::move(found.error());
  const Horizon& horizon = found->horizon;

  Result<std::vector<Lod>> chain = BuildLodChain((*input)->terrain(), horizon, plan->lods, control);
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
  MeshMeasurer measurer((*input)->terrain(), horizon, *std::move(places));
  const LevelContext context{
      (*input)->terrain(), horizon, (*input)->georeference(), *normals, measurer, control};
  Result<ReportPage> page =
      ReportPage::Start((*input)->terrain(), (*input)->georeference(), horizon);
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
  const EdgeFacts facts{LevelsKept(horizon, *chain), std::move(found->in_context)};
  Result<std::vector<HorizonFeature>> features = BuildFeatures(
      **input, horizon, facts, {.budget = budget, .threads = options.threads}, control);
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
                      static_cast<std::int64_t>(horizon.edges.size()),
                      CountInContext(options, facts),
                      horizon.statistics,
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
