// What the page says in words: what was read, what was assumed, and what is exact. Each sentence
// follows from the report's numbers, so that none is said of a build of which it is not true.
#include "core/pipeline/report_page/claims.h"

#include <string>

#include "core/pipeline/report_page/figures.h"

namespace farhorizon {

namespace {

Html Fact(const Html& term, const std::string& text, const char* classes = "") {
  return "<div>"_html + Element("dt", term) + Element("dd", Html::Text(text), classes) +
         "</div>"_html;
}

Html Item(const Html& head, const Html& text) {
  return "<li>"_html + Element("strong", head) + " "_html + text + "</li>"_html;
}

Html HorizonClaim(const Report& report) {
  const HorizonStatistics& s = report.statistics;
  const std::string found = Grouped(report.horizon_edges) + " of " +
                            Counted(s.terrain_edges, "edge", "edges") +
                            " are on the horizon in some direction.";
  if (s.undecided > 0) {
    return Item(
        "The horizon is a superset."_html,
        Html::Text(
            "The work budget ran out before " + Counted(s.undecided, "edge was", "edges were") +
            " decided. They are kept, so the skyline is the DEM's all the same, but " + found));
  }
  return Item("Every horizon edge is found, and none is guessed."_html,
              Html::Text(found + " " +
                         Counted(s.predicates.filtered + s.predicates.exact + s.predicates.tied,
                                 "comparison", "comparisons") +
                         " decided it: " + Grouped(s.predicates.filtered) +
                         " in doubles whose errors are bounded, " + Grouped(s.predicates.exact) +
                         " in exact arithmetic, " + Grouped(s.predicates.tied) + " as ties."));
}

Html LevelClaim(const Report& report) {
  const LevelReport& finest = report.levels.front();
  const std::string rounding = " Its vertices are then rounded to a lattice of " +
                               ThreeDigits(finest.quantization_step_m) +
                               " m, which the measured errors include.";
  const std::string kept = Grouped(finest.horizon_edges) + " of " +
                           Counted(report.horizon_edges, "horizon edge", "horizon edges");
  if (finest.exact) {
    return Item("Level 0 is exact."_html,
                Html::Text("It keeps " + kept +
                           " and rises above the skyline nowhere, so that "
                           "its skyline is the DEM's from every distant side." +
                           rounding));
  }
  return Item("No level is exact."_html,
              Html::Text("Level 0 was allowed to be off, or to have too few triangles: it keeps " +
                         kept + "." + rounding));
}

}  // namespace

Html FactsOf(const DemReport& dem) {
  const std::string quantum = ThreeDigits(dem.height_quantum_m) + " m";
  return "<dl class=\"facts\">"_html +
         Fact(
             "Posts"_html,
             Grouped(dem.columns) + " \u00d7 " + Grouped(dem.rows) +
                 (dem.nodata_posts > 0 ? ", " + Grouped(dem.nodata_posts) + " without data" : "")) +
         Fact("Apart"_html,
              ThreeDigits(dem.cell_m[0]) + " \u00d7 " + ThreeDigits(dem.cell_m[1]) + " m") +
         Fact("Heights"_html, ThreeDigits(dem.heights_m[0]) + " to " +
                                  ThreeDigits(dem.heights_m[1]) + " m, " +
                                  (dem.heights_rounded ? "rounded to " + quantum : "as stored")) +
         Fact("Reference system"_html, dem.crs) + Fact("SHA-256"_html, dem.sha256, "hash") +
         "</dl>"_html;
}

Html AssumptionList(const Assumptions& assumptions) {
  if (assumptions.empty()) return "<p>Nothing: the file says all that was needed.</p>"_html;
  Html list = "<ul>"_html;
  for (const Assumption& assumption : assumptions) {
    list += "<li>"_html + Html::Text(assumption.text) + " "_html +
            Element("code", Html::Text(assumption.code)) + "</li>"_html;
  }
  return list + "</ul>"_html;
}

Html ClaimList(const Report& report, bool has_geojson) {
  Html list = "<ol class=\"claims\">"_html + HorizonClaim(report);
  if (has_geojson) {
    list += Item("Each horizon edge has a witness."_html,
                 "For each there is a line of sight that touches it and nowhere meets higher "
                 "ground. <code>--horizon-detail edges</code> writes them to "
                 "<code>horizon.geojson</code>, and anyone can shoot them. Where no number is fine "
                 "enough to write one, it says so."_html);
  }
  return list + LevelClaim(report) +
         Item("Errors are those of the files."_html,
              "Each level was decoded again and measured: the vertical error at every post, the "
              "silhouette error up to a proven bound for all lines of sight. Lines with a skyline "
              "on "
              "the outline are told apart (at rims); lines that graze the outline are left out, "
              "where any rounding moves a skyline by any amount."_html) +
         Item("The same input and options give the same bytes,"_html,
              "whatever the number of threads, the machine's load and the build."_html) +
         "</ol>"_html;
}

}  // namespace farhorizon
