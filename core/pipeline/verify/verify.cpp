// Every claim of a folder of artifacts, measured again from the DEM and the files: the manifest,
// the DEM, the set of horizon edges (verify_features, verify_edges), each level (verify_level), the
// tileset. The horizon is found again, with the budget that the report names, so that an
// approximate one comes out the same.
#include "core/pipeline/verify/verify.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "core/horizon/find_horizon.h"
#include "core/io/file.h"
#include "core/io/horizon_features.h"
#include "core/io/manifest.h"
#include "core/io/tileset_reader.h"
#include "core/pipeline/level_artifact.h"
#include "core/pipeline/post_places.h"
#include "core/pipeline/report.h"
#include "core/pipeline/terrain_input.h"
#include "core/pipeline/verify/claims.h"
#include "core/pipeline/verify/verify_edges.h"
#include "core/pipeline/verify/verify_features.h"
#include "core/pipeline/verify/verify_level.h"

namespace farhorizon {

namespace {

namespace fs = std::filesystem;

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
  claims.Add(!fs::exists(directory / (name + ".glb"), failure) &&
                 !fs::exists(directory / (name + ".drc"), failure),
             name + " has no bytes in the report and no file: its numbers cannot be measured");
}

void VerifyLevels(const LevelContext& context, const fs::path& directory, const Report& report,
                  const std::optional<PublishedEdges>& published, Claims& claims) {
  const RunControl& control = context.control;
  std::vector<int> kept;
  if (published) kept.assign(published->edges.size(), -1);
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
    const std::vector<Edge> edges =
        VerifyLevel(context.With(level_control), directory, claimed, claims);
    claims.Add(
        claimed.geometric_error_m >= finer_error_m,
        "lod" + std::to_string(level) + " has no smaller geometric error than a finer level");
    finer_error_m = claimed.geometric_error_m;
    if (claimed.exact) {
      claims.Same("lod" + std::to_string(level) + " is exact and has every horizon edge",
                  report.horizon_edges, claimed.horizon_edges);
    }
    if (!published) continue;
    // An edge counts as kept as long as no finer level has lost it.
    std::int64_t here = 0;
    for (std::size_t i = 0; i < published->edges.size(); ++i) {
      if (kept[i] != static_cast<int>(level) - 1 ||
          !std::binary_search(edges.begin(), edges.end(), published->edges[i])) {
        continue;
      }
      kept[i] = static_cast<int>(level);
      ++here;
    }
    claims.Same("lod" + std::to_string(level) + " horizon edges", claimed.horizon_edges, here);
  }
  const bool all_written = std::none_of(report.levels.begin(), report.levels.end(), WasNotWritten);
  if (published && all_written) {
    claims.Add(kept == published->level_kept,
               "horizon.geojson: level_kept is the coarsest level that still has the edge");
  }
}

bool IsFrame(const std::array<double, 16>& claimed, const TerrainInput& input) {
  const std::array<double, 16> transform = input.georeference().frame().EnuToEcef();
  double off = 0;
  for (std::size_t i = 0; i < 16; ++i) off = std::max(off, std::abs(claimed[i] - transform[i]));
  // Far above what writing a double rounds, far below any rounding of vertices.
  return off < 1e-6;
}

void VerifyTileset(const TerrainInput& input, const fs::path& directory, const Report& report,
                   Claims& claims) {
  Result<std::string> text = ReadFile(directory / "tileset.json");
  if (!text) {
    claims.Add(false, "tileset.json: " + text.error().message);
    return;
  }
  Result<TilesetContents> tileset = ReadTileset(*text);
  claims.Add(tileset.has_value(), "tileset.json is a tileset with a tile for each level" +
                                      (tileset ? "" : ": " + tileset.error().message));
  if (!tileset) return;
  bool same = tileset->levels.size() == report.levels.size();
  for (std::size_t i = 0; same && i < report.levels.size(); ++i) {
    same = tileset->levels[i].uri == "lod" + std::to_string(i) + ".glb" &&
           tileset->levels[i].geometric_error_m == report.levels[i].geometric_error_m;
  }
  claims.Add(same, "tileset.json has the measured geometric errors");
  claims.Add(IsFrame(tileset->transform, input),
             "tileset.json places the local frame where the DEM is");
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

// True where the report says that some level has bytes of this kind: the format was asked for.
bool Has(const std::vector<LevelReport>& levels, std::int64_t LevelReport::*bytes) {
  return std::any_of(levels.begin(), levels.end(),
                     [bytes](const LevelReport& level) { return level.*bytes > 0; });
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
    claims.Add(IsFrame(report->frame->transform, **input),
               "report.json places the local frame where the DEM is");
  }
  if (report->dem.columns != (*input)->dem().columns || report->dem.rows != (*input)->dem().rows) {
    return std::move(claims).Take();
  }
  const HorizonOptions claimed = OptionsAsClaimed(*report, options.threads);
  WorkBudget budget = WorkBudgetOf((*input)->terrain(), claimed);
  Result<Horizon> horizon = FindHorizon((*input)->terrain(), claimed, budget, control);
  if (!horizon) return std::move(horizon.error());
  claims.Same("undecided edges", report->statistics.undecided, horizon->statistics.undecided);
  claims.Same("terrain edges", report->statistics.terrain_edges, (*input)->terrain().CountEdges());
  claims.Same("horizon edges", report->horizon_edges,
              static_cast<std::int64_t>(horizon->edges.size()));

  control.Report(Stage::kVerify, 0);
  std::optional<PublishedEdges> published;
  if (fs::exists(directory / "horizon.geojson")) {
    Result<std::string> geojson = ReadFile(directory / "horizon.geojson");
    if (!geojson) return std::move(geojson.error());
    Result<std::vector<HorizonFeature>> features = ReadHorizonGeoJson(*geojson);
    if (!features) return std::move(features.error());
    claims.Same("horizon.geojson features", report->horizon_edges,
                static_cast<std::int64_t>(features->size()));
    published = VerifyFeatures(**input, *features, claims);
    VerifySet(published->edges, *horizon, claims);
    claims.Same("horizon.geojson edges that are undecided", report->statistics.undecided,
                published->undecided);
    Result<std::vector<ClaimCheck>> edges = VerifyEdges(
        **input, *horizon, *features, {.budget = budget, .threads = options.threads}, control);
    if (!edges) return std::move(edges.error());
    claims.Append(*std::move(edges));
  } else {  // no edge's lines of sight are there to be compared
    control.Report(Stage::kLinesOfSight, 1);
    control.Report(Stage::kEdgeMeasures, 1);
  }
  control.Report(Stage::kVerify, kVerifiedWithSights);
  Result<PostNormals> normals =
      FindPostNormals((*input)->around(), (*input)->georeference(), (*input)->apron());
  if (!normals) return std::move(normals.error());
  Result<PostPlaces> places = FindPostPlaces((*input)->terrain(), (*input)->georeference());
  if (!places) return std::move(places.error());
  MeshMeasurer measurer((*input)->terrain(), *horizon, *std::move(places));
  const LevelContext context{
      (*input)->terrain(), *horizon, (*input)->georeference(), *normals, measurer, control};
  VerifyLevels(context, directory, *report, published, claims);
  if (Has(report->levels, &LevelReport::glb_bytes)) {
    VerifyTileset(**input, directory, *report, claims);
  }
  control.Report(Stage::kVerify, 1);
  return std::move(claims).Take();
}

}  // namespace farhorizon
