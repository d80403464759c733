// Every claim of a folder of artifacts, measured again from the DEM and the files: the manifest,
// the DEM, the set of horizon edges (verify_features, verify_edges), each level (verify_level), the
// tileset. The horizon is found again, with the budget that the report names, so that an
// approximate one comes out the same.
#include "core/pipeline/verify/verify.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <system_error>
#include <utility>

#include "core/horizon/find_horizon.h"
#include "core/io/file.h"
#include "core/io/horizon_chains.h"
#include "core/io/horizon_features.h"
#include "core/io/manifest.h"
#include "core/pipeline/build_features.h"
#include "core/pipeline/horizon_context.h"
#include "core/pipeline/level_artifact.h"
#include "core/pipeline/level_edges.h"
#include "core/pipeline/post_places.h"
#include "core/pipeline/report.h"
#include "core/pipeline/terrain_input.h"
#include "core/pipeline/verify/claims.h"
#include "core/pipeline/verify/kept_edges.h"
#include "core/pipeline/verify/verify_chains.h"
#include "core/pipeline/verify/verify_edges.h"
#include "core/pipeline/verify/verify_features.h"
#include "core/pipeline/verify/verify_level.h"
#include "core/pipeline/verify/verify_terrain.h"
#include "core/pipeline/verify/verify_tileset.h"

namespace farhorizon {

namespace {

namespace fs = std::filesystem;

// What is known of the horizon beside the claims: as horizon.geojson has it, if there is one, and
// as it was found again, with measures, if anything speaks of them.
struct HorizonClaims {
  std::optional<PublishedEdges> published;
  std::vector<HorizonFeature> found;
  std::vector<ClaimCheck> checks;
  int threads = 1;  ///< to look for the edges of levels with
};

// A folder of artifacts and its report.
struct Artifacts {
  const fs::path& directory;
  const Report& report;
};

Status VerifyManifest(const fs::path& directory, Claims& claims) {
  Result<std::string> text = ReadFile(directory / "manifest.json");
  if (!text) return std::move(text.error());
  Result<std::vector<ManifestEntry>> manifest = ReadManifest(*text);
  if (!manifest) return std::move(manifest.error());
  for (const ManifestEntry& entry : *manifest) {
    const fs::path path = directory / fs::path(entry.name).filename();
    Result<std::string> sha256 = Sha256OfFile(path);
    std::error_code failure;
    const bool holds = sha256 && *sha256 == entry.sha256 &&
                       fs::file_size(path, failure) == entry.bytes && !failure;
    claims.Add(holds, "manifest.json: " + entry.name + " has the bytes and the SHA-256 it names");
  }
  return Ok{};
}

void VerifyDem(const DemReport& claimed, const DemReport& found, Claims& claims) {
  claims.Same("dem sha256", claimed.sha256, found.sha256);
  claims.Same("dem columns", claimed.columns, found.columns);
  claims.Same("dem rows", claimed.rows, found.rows);
  claims.Same("dem crs", claimed.crs, found.crs);
  claims.Same("dem nodata_posts", claimed.nodata_posts, found.nodata_posts);
  claims.Same("dem least height", claimed.heights_m[0], found.heights_m[0]);
  claims.Same("dem greatest height", claimed.heights_m[1], found.heights_m[1]);
  claims.Same("dem cell width", claimed.cell_m[0], found.cell_m[0]);
  claims.Same("dem cell height", claimed.cell_m[1], found.cell_m[1]);
  claims.Same("dem height quantum", claimed.height_quantum_m, found.height_quantum_m);
}

// True where no format of the level's mesh was asked for: nothing of it can be measured again.
bool WasNotWritten(const LevelReport& level) {
  return level.glb_bytes == 0 && level.drc_bytes == 0;
}

// A level without files must have none, and then claims nothing that this could measure.
void VerifyAbsence(const fs::path& directory, const LevelReport& level, Claims& claims) {
  const std::string name = "lod" + std::to_string(level.level);
  std::error_code failure;
  claims.Add(!fs::exists(directory / PartGlbName(level.level, {}, {}), failure) &&
                 !fs::exists(directory / (name + ".drc"), failure) &&
                 !fs::exists(directory / HorizonGlbName(level.level), failure),
             name + " has no bytes in the report and no file: its numbers cannot be measured");
}

// What the levels' GLBs hold. contents: a level each, none of a level without any. globe: of the
// levels that have GLBs, for terrain tiles, if there are some.
struct VerifiedLevels {
  std::vector<std::vector<TileContentRegion>> contents;
  std::vector<TiledLevel> globe;
};

VerifiedLevels VerifyLevels(const LevelContext& context, const Artifacts& artifacts,
                            const HorizonClaims& horizon, Claims& claims) {
  const auto& [directory, report] = artifacts;
  const bool has_terrain = HasTerrain(directory);
  VerifiedLevels verified = {std::vector<std::vector<TileContentRegion>>(report.levels.size()), {}};
  const RunControl& control = context.control;
  KeptEdges kept(context.horizon);
  double finer_error_m = 0;
  for (std::size_t level = 0; level < report.levels.size(); ++level) {
    const RunControl level_control = LevelControl(control, level, report.levels.size());
    LevelControl(control.Between(kVerifiedWithSights, 1), level, report.levels.size())
        .Report(Stage::kVerify, 0);
    const LevelReport& claimed = report.levels[level];
    if (WasNotWritten(claimed)) {
      VerifyAbsence(directory, claimed, claims);
      continue;
    }
    const LevelContext level_context = context.With(level_control);
    std::optional<StoredLevel> stored = VerifyLevel(level_context, directory, claimed, claims);
    claims.Add(
        claimed.geometric_error_m >= finer_error_m,
        "lod" + std::to_string(level) + " has no smaller geometric error than a finer level");
    finer_error_m = claimed.geometric_error_m;
    if (claimed.exact) {
      claims.Same("lod" + std::to_string(level) + " is exact and has every horizon edge",
                  report.horizon_edges, claimed.horizon_edges);
    }
    if (!stored) continue;
    const std::vector<std::int32_t> here =
        kept.Take(static_cast<int>(level), EdgesByPost(stored->decoded.mesh));
    claims.Same("lod" + std::to_string(level) + " horizon edges", claimed.horizon_edges,
                std::ssize(here));
    if (claimed.glb_bytes == 0) continue;
    VerifyLevelEdges(level_context, directory, claimed, *stored,
                     {here, horizon.found, horizon.threads}, claims);
    verified.contents[level] = std::move(stored->contents);
    if (!has_terrain) continue;
    Result<GlobeMesh> globe = PlaceOnGlobe(context.georeference, stored->decoded.mesh);
    if (globe) verified.globe.push_back({*std::move(globe), claimed.geometric_error_m});
  }
  const bool all_written = std::none_of(report.levels.begin(), report.levels.end(), WasNotWritten);
  if (horizon.published && all_written) {
    claims.Add(kept.Are(*horizon.published),
               "horizon.geojson: level_kept is the coarsest level that still has the edge");
  }
  return verified;
}

// Checks horizon.geojson, and finds the measures of edges again where a file has some.
Result<HorizonClaims> VerifyHorizonFiles(const TerrainInput& input, const Horizon& horizon,
                                         const EdgeFacts& facts, const Artifacts& artifacts,
                                         const MeasureOptions& measuring,
                                         const RunControl& control) {
  HorizonClaims result;
  result.threads = measuring.threads;
  const fs::path path = artifacts.directory / "horizon.geojson";
  std::error_code none;
  const bool published = fs::exists(path, none);
  const bool drawn = std::ranges::any_of(artifacts.report.levels, [](const LevelReport& level) {
    return level.skyline_edges.bytes > 0;
  });
  if (!published && !drawn) {  // no edge's lines of sight are there to be compared
    control.Report(Stage::kLinesOfSight, 1);
    control.Report(Stage::kEdgeMeasures, 1);
    return result;
  }
  Result<std::vector<HorizonFeature>> found =
      BuildFeatures(input, horizon, facts, measuring, control);
  if (!found) return std::move(found.error());
  result.found = *std::move(found);
  control.Report(Stage::kVerify, kVerifiedBeforeSights);
  if (!published) return result;
  Result<std::string> geojson = ReadFile(path);
  if (!geojson) return std::move(geojson.error());
  Claims claims;
  std::vector<HorizonFeature> features;
  std::string source = "horizon.geojson";
  if (HasChains(*geojson)) {
    Result<std::vector<HorizonChain>> chains = ReadHorizonChains(*geojson);
    if (!chains) return std::move(chains.error());
    result.published = VerifyChains(input, *std::move(chains), result.found, claims);
    // Chains say nothing of single edges: what was found again is checked in its place.
    features = result.found;
    source = "horizon found again, of which horizon.geojson has chains:";
    VerifyFeatures(input, features, source, claims);
  } else {
    Result<std::vector<HorizonFeature>> read = ReadHorizonGeoJson(*geojson);
    if (!read) return std::move(read.error());
    features = *std::move(read);
    result.published = VerifyFeatures(input, features, source, claims);
  }
  claims.Same("horizon.geojson edges", artifacts.report.horizon_edges,
              std::ssize(result.published->edges));
  VerifySet(result.published->edges, horizon, claims);
  claims.Same("horizon.geojson edges that are undecided", artifacts.report.statistics.undecided,
              result.published->undecided);
  Result<std::vector<ClaimCheck>> edges =
      VerifyEdges(input, horizon, features, result.found, source);
  if (!edges) return std::move(edges.error());
  claims.Append(*std::move(edges));
  result.checks = std::move(claims).Take();
  return result;
}

// The report's budget alone decides what is left open: where it suffices, it makes no difference
// that it may be approximate.
HorizonOptions OptionsAsClaimed(const Report& report, int threads) {
  BuildOptions options;
  options.threads = threads;
  options.approximate = true;
  if (report.statistics.work_budget > 0) options.work_budget = report.statistics.work_budget;
  return HorizonOptionsOf(options);
}

}  // namespace

Result<std::vector<ClaimCheck>> VerifyArtifacts(const fs::path& dem, const fs::path& directory,
                                                const BuildOptions& options,
                                                const RunControl& control) {
  Claims claims;
  control.Report(Stage::kRead, 0);
  Status manifest = VerifyManifest(directory, claims);
  if (!manifest) return std::move(manifest.error());
  Result<std::string> text = ReadFile(directory / "report.json");
  if (!text) return std::move(text.error());
  Result<Report> report = ReadReport(*text);
  if (!report) return std::move(report.error());
  BuildOptions as_claimed = options;
  if (report->frame) as_claimed.frame = report->frame->axes;
  as_claimed.apron = report->dem.apron;
  if (Status sound = CheckOptions(as_claimed); !sound) return std::move(sound.error());
  Result<std::unique_ptr<TerrainInput>> input = TerrainInput::Open(dem, as_claimed, control);
  if (!input) return std::move(input.error());
  control.Report(Stage::kRead, 1);
  VerifyDem(report->dem, (*input)->report(), claims);
  if (report->frame) {
    claims.Add(PlacesFrame(report->frame->transform, **input),
               "report.json places the local frame where the DEM is");
  }
  if (report->dem.columns != (*input)->dem().columns || report->dem.rows != (*input)->dem().rows) {
    return std::move(claims).Take();
  }
  const HorizonOptions claimed = OptionsAsClaimed(*report, options.threads);
  WorkBudget budget = WorkBudgetOf((*input)->terrain(), claimed);
  Result<HorizonInContext> found =
      FindHorizonInContext(**input, report->edges_in_context.has_value(), claimed, budget, control);
  if (!found) return std::move(found.error());
  const Horizon& horizon = found->horizon;
  claims.Same("undecided edges", report->statistics.undecided, horizon.statistics.undecided);
  claims.Same("terrain edges", report->statistics.terrain_edges, (*input)->terrain().CountEdges());
  claims.Same("horizon edges", report->horizon_edges,
              static_cast<std::int64_t>(horizon.edges.size()));

  const EdgeFacts facts{{}, std::move(found->in_context)};
  if (report->edges_in_context) {
    claims.Same("horizon edges in context", *report->edges_in_context,
                std::ranges::count(facts.in_context, true));
  }

  control.Report(Stage::kVerify, 0);
  Result<HorizonClaims> horizon_claims =
      VerifyHorizonFiles(**input, horizon, facts, {directory, *report},
                         {.budget = budget, .threads = options.threads}, control);
  if (!horizon_claims) return std::move(horizon_claims.error());
  claims.Append(std::move(horizon_claims->checks));
  control.Report(Stage::kVerify, kVerifiedWithSights);
  Result<PostNormals> normals =
      FindPostNormals((*input)->around(), (*input)->georeference(), (*input)->apron());
  if (!normals) return std::move(normals.error());
  Result<PostPlaces> places = FindPostPlaces((*input)->terrain(), (*input)->georeference());
  if (!places) return std::move(places.error());
  MeshMeasurer measurer((*input)->terrain(), horizon, *std::move(places));
  const LevelContext context{
      (*input)->terrain(), horizon, (*input)->georeference(), *normals, measurer, control};
  VerifiedLevels levels = VerifyLevels(context, {directory, *report}, *horizon_claims, claims);
  VerifyTileset(**input, directory, report->levels, levels.contents, claims);
  // Without GLBs there is nothing that they could be compared with but the .drc's other order.
  const auto has_glb = [](const LevelReport& level) { return level.glb_bytes > 0; };
  if (HasTerrain(directory) && std::ranges::all_of(report->levels, has_glb)) {
    VerifyTerrain(directory, std::move(levels.globe), report->levels.size(), claims);
  }
  control.Report(Stage::kVerify, 1);
  return std::move(claims).Take();
}

}  // namespace farhorizon
