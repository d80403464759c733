// For people: three digits a figure, a table that fits a terminal, and notes only for what is not
// as usual. What makes a mesh unsound has a word of its own in front.
#include "core/pipeline/compare/comparison_text.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>

#include "core/pipeline/compare/level_summary.h"

namespace farhorizon {

namespace {

// Three digits that tell: 0.0123, 4.56, 123.
std::string Figure(double value) {
  std::array<char, 40> text{};
  const double size = std::abs(value);
  const int decimals = size == 0      ? 0
                       : size >= 100  ? 0
                       : size >= 10   ? 1
                       : size >= 1    ? 2
                       : size >= 0.01 ? 3
                                      : 4;
  std::snprintf(text.data(), text.size(), "%.*f", decimals, value);
  return text.data();
}

std::string Percent(double share) { return Figure(100 * share) + " %"; }

std::string Count(std::int64_t count) { return std::to_string(count); }

using Cells = std::vector<std::string>;

const Cells kHead = {"mesh",       "triangles",      "vertices", "vertical rms",
                     "max",        "silhouette rms", "at most",  "rim",
                     "facets deg", "needles",        "covered"};

Cells CellsOf(const MeshComparison& mesh) {
  if (mesh.fault) return {mesh.name, "not measured: " + *mesh.fault};
  const MeshError& e = mesh.error;
  return {mesh.name,
          Count(mesh.triangles),
          Count(mesh.vertices),
          Figure(e.vertical.rms_m),
          Figure(e.vertical.max_m),
          Figure(e.silhouette.rms_m),
          Figure(e.silhouette.max_m),
          Figure(e.rim_m),
          Figure(e.facet_angle_rms_deg),
          Percent(e.needle_share),
          Percent(mesh.covered_share)};
}

Cells CellsOf(const LevelSummary& level) {
  const std::string name =
      "depth " + std::to_string(level.depth) + ", " + Count(level.tiles) + " tiles";
  return {name,
          Count(level.triangles),
          Count(level.vertices),
          Figure(level.vertical.rms_m),
          Figure(level.vertical.max_m),
          "-",
          Figure(level.silhouette_max_m),
          Figure(level.rim_m),
          Figure(level.facet_angle_rms_deg),
          Percent(level.needle_share),
          ""};
}

// Names to the left, numbers to the right; a row with fewer cells runs on.
std::string Table(const std::vector<Cells>& rows) {
  std::vector<std::size_t> widths(kHead.size(), 0);
  for (const Cells& row : rows) {
    for (std::size_t i = 0; i < row.size() && row.size() == kHead.size(); ++i) {
      widths[i] = std::max(widths[i], row[i].size());
    }
    widths[0] = std::max(widths[0], row[0].size());
  }
  std::string text;
  for (const Cells& row : rows) {
    std::string line = row[0];
    line.resize(widths[0], ' ');
    for (std::size_t i = 1; i < row.size(); ++i) {
      line += "  ";
      if (row.size() == kHead.size()) line.append(widths[i] - row[i].size(), ' ');
      line += row[i];
    }
    text += line + "\n";
  }
  return text;
}

void AddNote(bool holds, const std::string& text, std::vector<std::string>& notes) {
  if (holds) notes.push_back(text);
}

std::vector<std::string> NotesOf(const MeshComparison& mesh) {
  std::vector<std::string> notes;
  const MeshDefects& defects = mesh.error.defects;
  AddNote(mesh.in_part,
          "it covers " + Count(mesh.posts) + " posts, " + Percent(mesh.covered_share) +
              " of the DEM's, and is compared with those alone",
          notes);
  AddNote(mesh.posts_without_data > 0,
          "it covers " + Count(mesh.posts_without_data) +
              " posts where the DEM has no data; what stands there counts in the silhouette",
          notes);
  AddNote(mesh.turned, "its triangles are clockwise seen from above; all were turned", notes);
  AddNote(mesh.skirt_triangles > 0,
          Count(mesh.skirt_triangles) + " upright triangles, skirts, were left out", notes);
  AddNote(mesh.polygons > 0, Count(mesh.polygons) + " polygons were cut into fans", notes);
  AddNote(defects.flipped > 0,
          "UNSOUND: " + Count(defects.flipped) + " triangles are flipped or flat in plan", notes);
  AddNote(defects.covered_twice > 0,
          "UNSOUND: triangles lie over one another at " + Count(defects.covered_twice) + " posts",
          notes);
  AddNote(defects.crowded_edges > 0,
          "UNSOUND: " + Count(defects.crowded_edges) + " edges have several triangles on one side",
          notes);
  AddNote(mesh.hole_posts > 0,
          "UNSOUND: holes leave out " + Count(mesh.hole_posts) + " posts of the DEM", notes);
  AddNote(defects.open_edges > 0,
          Count(defects.open_edges) +
              " edges with one triangle are not on the DEM's outline: "
              "cracks, T-junctions or another rim",
          notes);
  return notes;
}

}  // namespace

std::vector<std::string> PictureLines(const MeshComparison& mesh) {
  const MeshError& e = mesh.error;
  return {Count(mesh.triangles) + " triangles; vertical error rms " + Figure(e.vertical.rms_m) +
              " m, at most " + Figure(e.vertical.max_m) + " m; silhouette error rms " +
              Figure(e.silhouette.rms_m) + " m, at most " + Figure(e.silhouette.max_m) +
              " m (at the rim " + Figure(e.rim_m) + " m)",
          "facets turned by " + Figure(e.facet_angle_rms_deg) +
              " degrees (rms), needles: " + Percent(e.needle_share) + "; covers " +
              Percent(mesh.covered_share) + " of the DEM's posts"};
}

std::string ComparisonText(const Comparison& comparison) {
  const DemReport& dem = comparison.dem;
  std::string text = comparison.dem_name + ": " + Count(dem.columns) + " x " + Count(dem.rows) +
                     " posts of " + Figure(dem.cell_m[0]) + " x " + Figure(dem.cell_m[1]) +
                     " m, heights " + Figure(dem.heights_m[0]) + " to " + Figure(dem.heights_m[1]) +
                     " m, " + dem.crs + "\n\n";
  std::vector<Cells> rows = {kHead};
  for (const MeshComparison& mesh : comparison.meshes) rows.push_back(CellsOf(mesh));
  for (const LevelSummary& level : SummarizeLevels(comparison.meshes)) {
    rows.push_back(CellsOf(level));
  }
  text += Table(rows) + "\n";
  // What all meshes share is said once.
  std::vector<std::string> said;
  const auto say = [&](const std::string& line) {
    if (std::ranges::find(said, line) == said.end()) said.push_back(line);
  };
  for (const MeshComparison& mesh : comparison.meshes) {
    if (mesh.fault) continue;
    say(mesh.placing);
    for (const std::string& note : NotesOf(mesh)) {
      say(comparison.meshes.size() == 1 ? note : mesh.name + ": " + note);
    }
  }
  for (const std::string& line : said) text += line + "\n";
  return text +
         "errors in metres; silhouette: of the greatest height over plan lines, 'at most' "
         "proven, 'rim' with lines that graze the outline\n";
}

}  // namespace farhorizon
