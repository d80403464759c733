// Three passes, as each needs all levels of the one before. Levels are encoded; what they decode
// to, which is what clients get, is measured, all of them in one call; then their files are
// written, as the depth of a skirt depends on what was measured.
#include "core/pipeline/write_levels.h"

#include <algorithm>
#include <string>
#include <string_view>
#include <utility>

#include "core/pipeline/skirt.h"

namespace farhorizon {

namespace {

// The share of a level's part of Stage::kEncode after which its skyline is looked for.
constexpr double kEncoded = 0.3;

// What level i was asked for: by size, every further level two fifths of the triangles of the one
// before it.
LevelAsked AskedOf(const LevelPlan& plan, const std::vector<Lod>& chain, std::size_t i) {
  if (!plan.lods.triangles.empty()) return {.triangles = plan.lods.triangles[i]};
  if (i > 0) return {.triangles = std::ssize(chain[i - 1].mesh.triangles) * 2 / 5};
  return {.vertical_m = plan.max_error_m, .silhouette_m = plan.lods.silhouette_error_m};
}

// Writes the GLBs of a level, and adds what they cover to what is written.
Status WriteGlbs(const LevelContext& context, double skirt_m, LevelArtifact& level,
                 ArtifactWriter& writer, WrittenLevels& written) {
  Result<std::vector<PartGlb>> glbs = LevelGlbs(context, skirt_m, level);
  if (!glbs) return std::move(glbs.error());
  std::vector<TileContentRegion>& contents = written.contents.emplace_back();
  for (std::size_t i = 0; i < glbs->size(); ++i) {
    const PartGlb& glb = (*glbs)[i];
    if (Status added = writer.Add(glb.name, glb.bytes); !added) return added;
    MeshRegion region(context.georeference);
    if (Status added = region.Add(glb.surface); !added) return added;
    if (Status added = region.Add(glb.skirt); !added) return added;
    contents.push_back({level.parts[i].place, glb.name, region});
  }
  return Ok{};
}

// Writes the files of the levels that are asked for; by now all are measured, as skirts need it.
Status WriteFiles(const LevelContext& context, const TerrainInput& input,
                  const BuildOptions& options, std::vector<LevelArtifact>& levels,
                  ArtifactWriter& writer, WrittenLevels& written) {
  const std::vector<double> depths = SkirtDepths(input, written.reports, options.skirt_m);
  for (std::size_t i = 0; i < levels.size(); ++i) {
    LevelArtifact& level = levels[i];
    level.report = written.reports[i];
    if (!level.parts.empty()) {
      Status glbs = WriteGlbs(context, depths[i], level, writer, written);
      if (!glbs) return std::move(glbs.error()).WithContext("level " + std::to_string(i));
    }
    if (!level.drc.empty()) {
      const std::string name = "lod" + std::to_string(i) + ".drc";
      if (Status added = writer.Add(name, level.drc); !added) return added;
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

// Encodes a level and finds what is drawn of its skyline; `placed` gets the mesh to be measured.
Result<LevelArtifact> MakeLevel(const LevelContext& context, const Lod& lod, std::size_t number,
                                const LevelStorage& storage, const BuildOptions& options,
                                PlacedMesh& placed, WrittenLevels& written) {
  const RunControl encoding = context.control.Between(0, kEncoded);
  Result<LevelArtifact> level =
      EncodeLevel(context.With(encoding), lod, static_cast<int>(number), storage);
  if (!level) return level;
  Result<PlacedMesh> decoded = PlaceLevel(context, level->decoded.mesh);
  if (!decoded) return std::move(decoded.error()).WithContext("level " + std::to_string(number));
  placed = *std::move(decoded);
  if (storage.glb && options.edges != EdgeFiles::kNone) {
    const RunControl searching = context.control.Between(kEncoded, 1);
    Result<LevelEdges> edges = FindLevelEdges(context.With(searching), lod.kept,
                                              {level->decoded, placed}, options.threads);
    if (!edges) return std::move(edges.error());
    level->report.skyline_edges = edges->report;
    if (IsInline(options.edges)) level->flagged = edges->vertices;
    written.edges.push_back(*std::move(edges));
  }
  context.control.Report(Stage::kEncode, 1);
  return level;
}

}  // namespace

Result<WrittenLevels> WriteLevels(const LevelContext& context, const TerrainInput& input,
                                  const LevelPlan& plan, const std::vector<Lod>& chain,
                                  const BuildOptions& options, ArtifactWriter& writer,
                                  ReportPage& page) {
  WrittenLevels written;
  std::vector<LevelArtifact> levels;
  std::vector<LevelReport>& reports = written.reports;
  std::vector<PlacedMesh> decoded;
  for (std::size_t i = 0; i < chain.size(); ++i) {
    const RunControl control = LevelControl(context.control, i, chain.size());
    const bool glb = Asks(options, "3dtiles");
    const LevelStorage storage = {plan.finest_side_m, CoarsenessOf(plan, context.terrain.dem(), i),
                                  glb ? MostSkirtDepth(input, options.skirt_m) : 0, glb,
                                  Asks(options, "drc")};
    Result<LevelArtifact> level = MakeLevel(context.With(control), chain[i], i, storage, options,
                                            decoded.emplace_back(), written);
    if (!level) return std::move(level.error());
    level->report.asked = AskedOf(plan, chain, i);
    reports.push_back(level->report);
    if (Status drawn = page.AddLevel(level->decoded.mesh); !drawn) return std::move(drawn.error());
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

}  // namespace farhorizon
