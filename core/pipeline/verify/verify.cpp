// Every claim of a folder of artifacts, measured again from the DEM and the files.
#include "core/pipeline/verify/verify.h"

#include <algorithm>
#include <map>
#include <optional>
#include <random>
#include <utility>

#include "core/horizon/find_horizon.h"
#include "core/horizon/lines/highest_over_line.h"
#include "core/io/file.h"
#include "core/io/horizon_features.h"
#include "core/io/manifest.h"
#include "core/io/tileset.h"
#include "core/pipeline/level_artifact.h"
#include "core/pipeline/report.h"
#include "core/pipeline/terrain_input.h"
#include "core/pipeline/verify/claims.h"
#include "core/pipeline/verify/verify_edges.h"
#include "core/pipeline/verify/verify_level.h"

namespace farhorizon {
namespace {

namespace fs = std::filesystem;

constexpr int kRandomLines = 1000;

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
  return Done{};
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

// Lines through the terrain, drawn at random but the same each time.
PlanLine RandomLine(const Dem& dem, std::mt19937_64& random) {
  const auto draw = [&random](std::int32_t below) {
    return static_cast<std::int32_t>(random() % static_cast<std::uint64_t>(below));
  };
  PlanLine line{draw(2 * dem.columns), draw(2 * dem.rows), draw(2001) - 1000, draw(2001) - 1000};
  if (line.dc == 0 && line.dr == 0) line.dc = 1;
  return line;
}

// The set makes the terrain's skyline: on no line is the terrain higher than the set.
int LinesThatSeeMore(const Terrain& terrain, const std::vector<Segment>& set) {
  std::mt19937_64 random(20051);
  int more = 0;
  for (int i = 0; i < kRandomLines; ++i) {
    const PlanLine line = RandomLine(terrain.dem(), random);
    const std::optional<ExactHeight> ground = HighestOver(terrain, line);
    const std::optional<ExactHeight> found = HighestOver(set, line);
    more += (ground && (!found || Compare(*ground, *found) != 0)) ? 1 : 0;
  }
  return more;
}

struct PublishedEdges {
  std::vector<Edge> edges;
  std::vector<int> level_kept;
  std::int64_t undecided = 0;
};

// Features by the terrain's own names; counts those that name no edge or stand elsewhere.
PublishedEdges VerifyFeatures(const TerrainInput& source,
                              const std::vector<HorizonFeature>& features, Claims& claims) {
  const Dem& dem = source.dem();
  PublishedEdges published;
  std::vector<VertexId> ends;
  std::int64_t astray = 0;
  std::int64_t blind = 0;
  std::vector<Segment> set;
  for (const HorizonFeature& f : features) {
    const auto inside = [&dem](const std::array<std::int32_t, 2>& p) {
      return p[0] >= 0 && p[0] < dem.columns && p[1] >= 0 && p[1] < dem.rows;
    };
    if (!inside(f.a) || !inside(f.b)) {
      ++astray;
      continue;
    }
    const Edge edge{f.a[1] * dem.columns + f.a[0], f.b[1] * dem.columns + f.b[0]};
    const bool holds =
        edge.a < edge.b && (f.undecided || WitnessHolds(source.terrain(), edge, f.witness));
    blind += holds ? 0 : 1;
    published.undecided += f.undecided ? 1 : 0;
    published.edges.push_back(edge);
    published.level_kept.push_back(f.level_kept.value_or(-1));
    ends.push_back(edge.a);
    ends.push_back(edge.b);
    set.push_back({source.terrain().Point(edge.a), source.terrain().Point(edge.b)});
  }
  Result<std::vector<Geodetic>> places = source.georeference().ToGeodetic(ends);
  for (std::size_t i = 0; places && i < published.edges.size() && astray == 0; ++i) {
    const auto near = [](const Geodetic& a, const Geodetic& b) {
      return std::abs(a.lon_deg - b.lon_deg) < 1e-8 && std::abs(a.lat_deg - b.lat_deg) < 1e-8 &&
             std::abs(a.height_m - b.height_m) < 1e-3;
    };
    const bool there =
        near((*places)[2 * i], features[i].from) && near((*places)[2 * i + 1], features[i].to);
    astray += there ? 0 : 1;
  }
  claims.Same("horizon.geojson edges that are not where their posts are", std::int64_t{0}, astray);
  claims.Same("horizon.geojson witnesses that meet higher ground", std::int64_t{0}, blind);
  claims.Same(
      std::to_string(kRandomLines) + " random lines of sight with ground above every horizon edge",
      0, LinesThatSeeMore(source.terrain(), set));
  return published;
}

void VerifySet(const std::vector<Edge>& claimed, const Horizon& horizon, Claims& claims) {
  std::vector<Edge> found;
  found.reserve(horizon.edges.size());
  for (const HorizonEdge& e : horizon.edges) found.push_back(e.edge);
  std::vector<Edge> sorted = claimed;
  std::sort(sorted.begin(), sorted.end());
  std::vector<Edge> missing;
  std::set_difference(found.begin(), found.end(), sorted.begin(), sorted.end(),
                      std::back_inserter(missing));
  std::vector<Edge> extra;
  std::set_difference(sorted.begin(), sorted.end(), found.begin(), found.end(),
                      std::back_inserter(extra));
  claims.Same("horizon edges missing from horizon.geojson", std::size_t{0}, missing.size());
  claims.Same("edges in horizon.geojson that are not on the horizon", std::size_t{0}, extra.size());
}

void VerifyLevels(const TerrainInput& source, const Horizon& horizon, const fs::path& directory,
                  const Report& report, const std::optional<PublishedEdges>& published,
                  const PostNormals& normals, const Watch& watch, Claims& claims) {
  const LevelContext context{source.terrain(), horizon, source.georeference(), normals, watch};
  std::vector<int> kept;
  if (published) kept.assign(published->edges.size(), -1);
  double finer_error_m = 0;
  for (std::size_t level = 0; level < report.levels.size(); ++level) {
    watch.Report("verify", static_cast<double>(level) / static_cast<double>(report.levels.size()));
    const LevelReport& claimed = report.levels[level];
    const std::vector<Edge> edges = VerifyLevel(context, directory, claimed, claims);
    claims.Add(
        claimed.geometric_error_m >= finer_error_m,
        "lod" + std::to_string(level) + " has no smaller geometric error than a finer level");
    finer_error_m = claimed.geometric_error_m;
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
  if (published) {
    claims.Add(kept == published->level_kept,
               "horizon.geojson: level_kept is the coarsest level that still has the edge");
  }
}

void VerifyTileset(const TerrainInput& source, const fs::path& directory, const Report& report,
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
  const std::array<double, 16> transform = source.georeference().frame().EnuToEcef();
  double off = 0;
  for (std::size_t i = 0; i < 16; ++i) {
    off = std::max(off, std::abs(tileset->transform[i] - transform[i]));
  }
  claims.Add(off < 1e-6, "tileset.json places the local frame where the DEM is");
}

// What is approximate was made so by the budget alone, and comes out the same again.
Result<Horizon> FindAsClaimed(const TerrainInput& source, const Report& report, int threads,
                              const Watch& watch) {
  HorizonOptions options{.threads = threads, .approximate = report.statistics.undecided > 0};
  if (report.statistics.work_budget > 0) options.work_budget = report.statistics.work_budget;
  return FindHorizon(source.terrain(), options, watch);
}

// What the report was made with, as far as the files tell.
bool Has(const std::vector<LevelReport>& levels, std::int64_t LevelReport::*bytes) {
  return std::any_of(levels.begin(), levels.end(),
                     [bytes](const LevelReport& level) { return level.*bytes > 0; });
}

}  // namespace

Result<std::vector<ClaimCheck>> VerifyArtifacts(const fs::path& dem, const fs::path& directory,
                                                const BuildOptions& options, const Watch& watch) {
  Claims claims;
  Status manifest = VerifyManifest(directory, claims);
  if (!manifest) return std::move(manifest.error());
  Result<std::string> text = ReadFile(directory / "report.json");
  if (!text) return std::move(text.error());
  Result<Report> report = ReadReport(*text);
  if (!report) return std::move(report.error());
  watch.Report("read", 0);
  Result<std::unique_ptr<TerrainInput>> source = TerrainInput::Open(dem, options);
  if (!source) return std::move(source.error());
  VerifyDem(report->dem, (*source)->report(), claims);
  if (report->dem.columns != (*source)->dem().columns ||
      report->dem.rows != (*source)->dem().rows) {
    return std::move(claims).Take();
  }
  Result<Horizon> horizon = FindAsClaimed(**source, *report, options.threads, watch);
  if (!horizon) return std::move(horizon.error());
  claims.Same("undecided edges", report->statistics.undecided, horizon->statistics.undecided);
  claims.Same("terrain edges", report->statistics.terrain_edges, (*source)->terrain().CountEdges());
  claims.Same("horizon edges", report->horizon_edges,
              static_cast<std::int64_t>(horizon->edges.size()));

  std::optional<PublishedEdges> published;
  if (fs::exists(directory / "horizon.geojson")) {
    Result<std::string> geojson = ReadFile(directory / "horizon.geojson");
    if (!geojson) return std::move(geojson.error());
    Result<std::vector<HorizonFeature>> features = ReadHorizonGeoJson(*geojson);
    if (!features) return std::move(features.error());
    claims.Same("horizon.geojson features", report->horizon_edges,
                static_cast<std::int64_t>(features->size()));
    published = VerifyFeatures(**source, *features, claims);
    VerifySet(published->edges, *horizon, claims);
    claims.Same("horizon.geojson edges that are undecided", report->statistics.undecided,
                published->undecided);
    Status sights = VerifyEdges(**source, *horizon, *features, options.threads, watch, claims);
    if (!sights) return std::move(sights.error());
  }
  Result<PostNormals> normals = FindPostNormals((*source)->terrain(), (*source)->georeference());
  if (!normals) return std::move(normals.error());
  VerifyLevels(**source, *horizon, directory, *report, published, *normals, watch, claims);
  if (Has(report->levels, &LevelReport::glb_bytes)) {
    VerifyTileset(**source, directory, *report, claims);
  }
  return std::move(claims).Take();
}

}  // namespace farhorizon
