#include "core/pipeline/report_page/account.h"

#include <algorithm>
#include <string>

#include "core/base/stage.h"
#include "core/pipeline/level_edges.h"
#include "core/pipeline/report_page/bar_table.h"
#include "core/pipeline/report_page/figures.h"

namespace farhorizon {

namespace {

// The level that an artifact is of; nullptr for what belongs to no level alone.
const LevelReport* LevelOf(const std::vector<LevelReport>& levels, const std::string& name) {
  for (const LevelReport& level : levels) {
    const std::string stem = "lod" + std::to_string(level.level);
    if (name == stem + ".glb" || name == stem + ".drc") return &level;
  }
  return nullptr;
}

std::string Each(std::uintmax_t bytes, std::int64_t count, const char* what) {
  if (count == 0) return "";
  return ThreeDigits(static_cast<double>(bytes) / static_cast<double>(count)) + " a " + what;
}

std::string BytesEach(const Report& report, const ManifestEntry& artifact) {
  if (const LevelReport* level = LevelOf(report.levels, artifact.name)) {
    return Each(artifact.bytes, level->triangles, "triangle");
  }
  for (const LevelReport& level : report.levels) {
    if (artifact.name != HorizonGlbName(level.level)) continue;
    return Each(artifact.bytes, level.skyline_edges.edges, "horizon edge");
  }
  const bool edges = artifact.name == "horizon.geojson" || artifact.name == "horizon.fgb" ||
                     artifact.name == "horizon.gpkg";
  return edges ? Each(artifact.bytes, report.horizon_edges, "horizon edge") : "";
}

// The artifacts, those of terrain tiles as one.
std::vector<ManifestEntry> Summed(const std::vector<ManifestEntry>& artifacts) {
  std::vector<ManifestEntry> summed;
  ManifestEntry tiles;
  std::int64_t count = 0;
  for (const ManifestEntry& artifact : artifacts) {
    if (!artifact.name.ends_with(".terrain")) {
      summed.push_back(artifact);
      continue;
    }
    tiles.bytes += artifact.bytes;
    ++count;
  }
  if (count > 0) {
    tiles.name = std::to_string(count) + " tiles, terrain-Z-X-Y.terrain";
    summed.push_back(tiles);
  }
  return summed;
}

}  // namespace

Html BytesTable(const Report& report, const std::vector<ManifestEntry>& artifacts) {
  BarTable table{"The files of this build, without this page and the manifest"_html,
                 {"File"_html, "Size"_html, "Bytes"_html},
                 {}};
  std::vector<ManifestEntry> sorted = Summed(artifacts);
  std::stable_sort(
      sorted.begin(), sorted.end(),
      [](const ManifestEntry& a, const ManifestEntry& b) { return a.bytes > b.bytes; });
  for (const ManifestEntry& artifact : sorted) {
    table.rows.push_back({Html::Text(artifact.name),
                          static_cast<double>(artifact.bytes),
                          {Html::Text(ByteCount(static_cast<std::int64_t>(artifact.bytes))),
                           Html::Text(BytesEach(report, artifact))}});
  }
  return DrawBars(table);
}

Html TimesTable(const StageSeconds& seconds) {
  if (seconds.empty()) {
    return "<p>Not here: the same input gives the same page, byte for byte. "
           "<code>farhorizon build --timings FILE</code> writes the seconds of each stage into "
           "FILE "
           "and into this section; a job's status has them as <code>timings</code>.</p>"_html;
  }
  double sum = 0;
  for (const auto& [stage, spent] : seconds) sum += spent;
  BarTable table{Html::Text(ThreeDigits(sum) +
                            " seconds until this page was made, by stage. With times, the page has "
                            "other bytes from run to run"),
                 {"Stage"_html, "Seconds"_html, "Share"_html},
                 {}};
  for (const Stage stage : kStages) {
    const auto found = seconds.find(StageName(stage));
    if (found == seconds.end()) continue;
    table.rows.push_back(
        {Html::Text(found->first),
         found->second,
         {Html::Text(ThreeDigits(found->second)), Html::Text(PercentOf(found->second, sum))}});
  }
  return DrawBars(table);
}

}  // namespace farhorizon
