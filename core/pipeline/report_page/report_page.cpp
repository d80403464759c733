// The sections in their order, around one choice of level that the pictures and charts share. What
// is asked of the whole page is here: its policy lets its own script alone run, by the script's
// hash.
#include "core/pipeline/report_page/report_page.h"

#include <map>
#include <utility>

#include "core/io/base64.h"
#include "core/io/sha256.h"
#include "core/pipeline/report_page/account.h"
#include "core/pipeline/report_page/claims.h"
#include "core/pipeline/report_page/error_chart.h"
#include "core/pipeline/report_page/figures.h"
#include "core/pipeline/report_page/height_raster.h"
#include "core/pipeline/report_page/level_table.h"
#include "core/pipeline/report_page/map_section.h"
#include "core/pipeline/report_page/page_parts.h"
#include "core/pipeline/report_page/relief.h"

namespace farhorizon {

namespace {

std::int64_t CountTriangles(const Terrain& terrain) {
  std::int64_t count = 0;
  for (std::int32_t row = 0; row + 1 < terrain.dem().rows; ++row) {
    for (std::int32_t column = 0; column + 1 < terrain.dem().columns; ++column) {
      count += terrain.Cell(column, row).count;
    }
  }
  return count;
}

Html SkylineFigure(int azimuth_deg, const Html& chart) {
  return "<figure><figcaption>Looking "_html + Html::Text(PointOfCompass(azimuth_deg)) +
         "</figcaption>"_html + chart + "</figure>"_html;
}

// The charts of the four points of the compass, or of those between.
Html SkylineFigures(const std::vector<SkylineSet>& sets, std::size_t first) {
  const SkylineScale scale = ScaleOf(sets);
  Html html;
  for (std::size_t i = first; i < sets.size(); i += 2) {
    html += SkylineFigure(static_cast<int>(45 * i), SkylineChart(sets[i], scale));
  }
  for (std::size_t i = first; i < sets.size(); i += 2) {
    html += SkylineFigure(static_cast<int>(45 * i + 180), MirroredSkylineChart(sets[i], scale));
  }
  return html;
}

Html LevelChoice(std::size_t levels) {
  Html html =
      "<fieldset class=\"choice\" data-for=\"skylines\"><legend>Show</legend><label><input "
      "type=\"radio\" name=\"skyline\" value=\"all\" checked><span>All levels</span></label>"_html;
  for (std::size_t i = 0; i < levels; ++i) {
    const std::string number = std::to_string(i);
    html += Html::Markup("<label><input type=\"radio\" name=\"skyline\" value=\"" + number +
                         "\"><span><svg class=\"swatch\" viewBox=\"0 0 10 10\" "
                         "aria-hidden=\"true\"><path class=\"lod" +
                         number + "\" d=\"M0 5H10\"/></svg>Level " + number + "</span></label>");
  }
  return html + "</fieldset>"_html;
}

// A sentence of what was made of what.
Html Summary(const Report& report, std::int64_t terrain_triangles) {
  const LevelReport& finest = report.levels.front();
  return Html::Text(
      Counted(report.dem.columns, "column", "columns") + " and " +
      Counted(report.dem.rows, "row", "rows") + " of heights, " +
      Counted(report.horizon_edges, "horizon edge", "horizon edges") + ", " +
      Counted(static_cast<std::int64_t>(report.levels.size()), "level", "levels") +
      " of detail. The finest has " +
      PercentOf(static_cast<double>(finest.triangles), static_cast<double>(terrain_triangles)) +
      " of all triangles and a skyline that is off by " + ThreeDigits(finest.silhouette.rms_m) +
      " m (root mean square), by no more than " + ThreeDigitsUp(finest.silhouette.max_m) +
      " m where it is not on the terrain's outline.");
}

std::string HashOf(std::string_view text) {
  Sha256 sum;
  sum.Add(text);
  return sum.Finish().Base64();
}

bool HasArtifact(const std::vector<ManifestEntry>& artifacts, std::string_view name) {
  for (const ManifestEntry& artifact : artifacts) {
    if (artifact.name == name) return true;
  }
  return false;
}

}  // namespace

Result<ReportPage> ReportPage::Start(const Terrain& terrain, const Georeference& georeference,
                                     const Horizon& horizon) {
  const Dem& dem = terrain.dem();
  Result<std::vector<GroundStep>> step =
      georeference.StepsAt({{(dem.columns - 1) / 2.0, (dem.rows - 1) / 2.0}});
  if (!step) return std::move(step.error());
  ReportPage page(terrain, georeference);
  page.step_ = step->front();
  page.frame_ = FrameOf(dem, page.step_);
  const HeightRaster raster = RasterOf(terrain, page.frame_);
  page.base_m_ = raster.base_m;
  page.exaggeration_ = ReliefExaggeration(raster, page.frame_);
  page.reliefs_.push_back(ShadedRelief(raster, page.frame_, page.exaggeration_));
  for (const int azimuth : {0, 45, 90, 135}) {
    SkylineSet set{LinesAcross(dem, page.step_, azimuth, kLinesAcross), {}, {}};
    set.terrain = ProfileOf(dem, horizon, set.lines);
    page.skylines_.push_back(std::move(set));
  }
  return page;
}

Status ReportPage::AddLevel(const LocalMesh& decoded) {
  Result<std::vector<GridPoint>> points = georeference_->ToGrid(decoded.positions);
  if (!points) return std::move(points.error());
  GridMesh mesh{*std::move(points), {}};
  mesh.triangles.reserve(decoded.triangles.size());
  for (const std::array<std::uint32_t, 3>& t : decoded.triangles) {
    mesh.triangles.push_back({static_cast<std::int32_t>(t[0]), static_cast<std::int32_t>(t[1]),
                              static_cast<std::int32_t>(t[2])});
  }
  reliefs_.push_back(ShadedRelief(RasterOf(mesh, frame_, base_m_), frame_, exaggeration_));
  for (SkylineSet& set : skylines_) set.levels.push_back(ProfileOf(mesh, set.lines));
  return Ok{};
}

Result<std::string> ReportPage::Write(const PageContents& contents) const {
  Check(reliefs_.size() == contents.report.levels.size() + 1, "every level was added to the page");
  const Report& report = contents.report;
  const std::int64_t triangles = CountTriangles(*terrain_);
  Result<Html> map =
      MapSection({report, contents.features, frame_, reliefs_, step_, exaggeration_, triangles});
  if (!map) return std::move(map.error());
  return FillTemplate(
      kPageHtml, {{"style", Html::Markup(std::string(kPageCss))},
                  {"script", Html::Markup(std::string(kPageJs))},
                  {"script_hash", Html::Markup(HashOf(kPageJs))},
                  {"banner", SkylineBanner(skylines_.front())},
                  {"summary", Summary(report, triangles)},
                  {"facts", FactsOf(report.dem)},
                  {"map", *map},
                  {"skyline_choice", LevelChoice(report.levels.size())},
                  {"skylines", SkylineFigures(skylines_, 0)},
                  {"more_skylines", SkylineFigures(skylines_, 1)},
                  {"lines", Html::Text(Grouped(kLinesAcross))},
                  {"skyline_table", SkylineTable(skylines_)},
                  {"error_chart", ErrorChart(report.levels)},
                  {"levels", LevelTable(report, triangles)},
                  {"bytes", BytesTable(report, contents.artifacts)},
                  {"times", TimesTable(contents.seconds)},
                  {"assumptions", AssumptionList(report.assumptions)},
                  {"claims", ClaimList(report, HasArtifact(contents.artifacts, "horizon.geojson"))},
                  {"version", Html::Text(report.version)}});
}

}  // namespace farhorizon
