// Where the bytes of a build went, and its time. Files that come in hundreds, terrain tiles and the
// parts of a level, are summed: a row each would hide the others.
#include "core/pipeline/report_page/account.h"

#include <algorithm>
#include <map>
#include <optional>
#include <string>
#include <utility>

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
    if (name.ends_with(stem + "-X-Y.glb")) return &level;
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

// Where a level is cut, the number of the level whose part the artifact is; nullopt for what is
// no such part.
std::optional<int> CutLevelOf(const std::vector<LevelReport>& levels, const std::string& name) {
  for (const LevelReport& level : levels) {
    if (level.parts == PartDepth{} || !name.ends_with(".glb")) continue;
    const std::string stem = "lod" + std::to_string(level.level) + "-";
    if (name.starts_with(stem) && name != HorizonGlbName(level.level)) return level.level;
  }
  return std::nullopt;
}

// Artifacts that are shown as one, by the name that they have together.
class Sums {
 public:
  void Add(const ManifestEntry& artifact, const std::string& together) {
    auto& [count, bytes] = sums_[together];
    ++count;
    bytes += artifact.bytes;
  }
  void Show(std::vector<ManifestEntry>& artifacts) const {
    for (const auto& [together, sum] : sums_) {
      ManifestEntry& entry = artifacts.emplace_back();
      entry.name = std::to_string(sum.first) + " tiles, " + together;
      entry.bytes = sum.second;
    }
  }

 private:
  std::map<std::string, std::pair<std::int64_t, std::uintmax_t>> sums_;
};

// The artifacts, terrain tiles as one, and the parts of a level.
std::vector<ManifestEntry> Summed(const std::vector<LevelReport>& levels,
                                  const std::vector<ManifestEntry>& artifacts) {
  std::vector<ManifestEntry> summed;
  Sums sums;
  for (const ManifestEntry& artifact : artifacts) {
    if (artifact.name.ends_with(".terrain")) {
      sums.Add(artifact, "terrain-Z-X-Y.terrain");
    } else if (const std::optional<int> level = CutLevelOf(levels, artifact.name)) {
      sums.Add(artifact, "lod" + std::to_string(*level) + "-X-Y.glb");
    } else {
      summed.push_back(artifact);
    }
  }
  sums.Show(summed);
  return summed;
}

}  // namespace

Html BytesTable(const Report& report, const std::vector<ManifestEntry>& artifacts) {
  BarTable table{"The files of this build, without this page and the manifest"_html,
                 {"File"_html, "Size"_html, "Bytes"_html},
                 {}};
  std::vector<ManifestEntry> sorted = Summed(report.levels, artifacts);
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
