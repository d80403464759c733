// The numbers of report.json that people compare levels by, as tables that a phone and a keyboard
// can scroll.
#include "core/pipeline/report_page/level_table.h"

#include <cmath>
#include <string>

#include "core/pipeline/report_page/figures.h"

namespace farhorizon {

namespace {

// A cell with its number.
Html Cell(const std::string& text) { return Element("td", Html::Text(text), "number"); }

// A table under its caption. It is wider than a phone, so it scrolls sideways, also by keyboard;
// the caption does not.
Html Scrolling(const char* id, const Html& caption, const Html& table) {
  const std::string name = "\"" + std::string(id) + "\"";
  return Html::Markup("<p class=\"note\" id=" + name + ">") + caption +
         Html::Markup(
             "</p><div class=\"scrolling\" role=\"region\" tabindex=\"0\" "
             "aria-labelledby=" +
             name + "><table aria-labelledby=" + name + ">") +
         table + "</table></div>"_html;
}

Html RowOf(const LevelReport& level, std::int64_t terrain_triangles, std::int64_t horizon_edges) {
  const auto share = [](std::int64_t part, std::int64_t whole) {
    return PercentOf(static_cast<double>(part), static_cast<double>(whole));
  };
  return "<tr><th scope=\"row\">"_html +
         Html::Text(std::to_string(level.level) + (level.exact ? ", exact" : "")) + "</th>"_html +
         Cell(Grouped(level.triangles)) + Cell(share(level.triangles, terrain_triangles)) +
         Cell(Grouped(level.vertices)) + Cell(Grouped(level.horizon_edges)) +
         Cell(share(level.horizon_edges, horizon_edges)) + Cell(ThreeDigits(level.vertical.rms_m)) +
         Cell(ThreeDigitsUp(level.vertical.max_m)) + Cell(ThreeDigits(level.silhouette.rms_m)) +
         Cell(ThreeDigitsUp(level.silhouette.max_m)) + Cell(ThreeDigitsUp(level.rim_m)) +
         Cell(ThreeDigits(level.facet_angle_deg) + "\u00b0") +
         Cell(PercentOf(level.needle_share, 1)) + Cell(ThreeDigitsUp(level.geometric_error_m)) +
         Cell(ThreeDigits(level.quantization_step_m)) + "</tr>"_html;
}

}  // namespace

Html LevelTable(const Report& report, std::int64_t terrain_triangles) {
  Html table =
      "<thead><tr><th scope=\"col\" rowspan=\"2\">Level</th>"
      "<th scope=\"colgroup\" colspan=\"2\">Triangles</th>"
      "<th scope=\"col\" rowspan=\"2\" class=\"number\">Vertices</th>"
      "<th scope=\"colgroup\" colspan=\"2\">Horizon edges kept</th>"
      "<th scope=\"colgroup\" colspan=\"2\">Vertical error</th>"
      "<th scope=\"colgroup\" colspan=\"3\">Silhouette error</th>"
      "<th scope=\"colgroup\" colspan=\"2\">Look when lit</th>"
      "<th scope=\"col\" rowspan=\"2\" class=\"number\">Geometric<br>error</th>"
      "<th scope=\"col\" rowspan=\"2\" class=\"number\">Rounding<br>step</th></tr><tr>"
      "<th scope=\"col\" class=\"number\">count</th><th scope=\"col\" class=\"number\">of all</th>"
      "<th scope=\"col\" class=\"number\">count</th><th scope=\"col\" class=\"number\">of all</th>"
      "<th scope=\"col\" class=\"number\">rms</th><th scope=\"col\" class=\"number\">greatest</th>"
      "<th scope=\"col\" class=\"number\">rms</th><th scope=\"col\" class=\"number\">at most</th>"
      "<th scope=\"col\" class=\"number\">at rims</th>"
      "<th scope=\"col\" class=\"number\">facets off</th>"
      "<th scope=\"col\" class=\"number\">needles</th>"
      "</tr></thead><tbody>"_html;
  for (const LevelReport& level : report.levels) {
    table += RowOf(level, terrain_triangles, report.horizon_edges);
  }
  return Scrolling(
      "levels",
      "The levels, measured on the decoded meshes; errors in metres. At rims: the greatest "
      "error, lines with a skyline on the outline included. Facets off: the angle to "
      "the DEM's, root mean square. Needles: triangles with an angle below 2 degrees"_html,
      table + "</tbody>"_html);
}

Html SkylineTable(const std::vector<SkylineSet>& sets) {
  Html table = "<thead><tr><th scope=\"col\">Level</th>"_html;
  for (const SkylineSet& set : sets) {
    const auto azimuth = static_cast<int>(std::lround(set.lines.azimuth_deg));
    table += Element(
        "th", Html::Text(PointOfCompass(azimuth) + ", " + PointOfCompass(azimuth + 180)), "number");
  }
  table += "</tr></thead><tbody>"_html;
  for (std::size_t level = 0; level < sets.front().levels.size(); ++level) {
    table += "<tr><th scope=\"row\">"_html + Html::Text(std::to_string(level)) + "</th>"_html;
    for (const SkylineSet& set : sets) {
      const SkylineDifference off = DifferenceOf(set.terrain, set.levels[level]);
      table += Cell(ThreeDigits(off.rms_m) + " / " + ThreeDigits(off.greatest_m));
    }
    table += "</tr>"_html;
  }
  return Scrolling("differences",
                   "How far the levels' skylines are off on the lines that are drawn, in metres: "
                   "root mean square / greatest, lines with a skyline on the outline included"_html,
                   table + "</tbody>"_html);
}

}  // namespace farhorizon
