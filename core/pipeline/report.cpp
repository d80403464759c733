// report.json, written and read member by member in the order of the structs; nlohmann's
// ordered_json keeps that order, so that the same report has the same bytes.
#include "core/pipeline/report.h"

#include <cmath>

#include <nlohmann/json.hpp>

namespace farhorizon {

namespace {

using OrderedJson = nlohmann::ordered_json;

OrderedJson ToJson(const ErrorMeasure& error) {
  return {{"max", error.max_m}, {"rms", error.rms_m}};
}

OrderedJson ToJson(const ErrorMeasure& silhouette, double rim_m) {
  OrderedJson json = ToJson(silhouette);
  json["rim"] = rim_m;
  return json;
}

ErrorMeasure ReadMeasure(const OrderedJson& json) {
  return {json.at("max").get<double>(), json.at("rms").get<double>()};
}

OrderedJson ToJson(const DemReport& dem) {
  return {{"columns", dem.columns},
          {"rows", dem.rows},
          {"crs", dem.crs},
          {"cell_m", dem.cell_m},
          {"heights_m", dem.heights_m},
          {"height_quantum_m", dem.height_quantum_m},
          {"heights_rounded", dem.heights_rounded},
          {"apron", dem.apron},
          {"nodata_posts", dem.nodata_posts},
          {"sha256", dem.sha256}};
}

DemReport ReadDemReport(const OrderedJson& json) {
  DemReport dem;
  json.at("columns").get_to(dem.columns);
  json.at("rows").get_to(dem.rows);
  json.at("crs").get_to(dem.crs);
  json.at("cell_m").get_to(dem.cell_m);
  json.at("heights_m").get_to(dem.heights_m);
  json.at("height_quantum_m").get_to(dem.height_quantum_m);
  json.at("heights_rounded").get_to(dem.heights_rounded);
  dem.apron = json.value("apron", 0);  // reports of versions without aprons have no such member
  json.at("nodata_posts").get_to(dem.nodata_posts);
  json.at("sha256").get_to(dem.sha256);
  return dem;
}

OrderedJson ToJson(const Assumptions& assumptions) {
  OrderedJson list = OrderedJson::array();
  for (const Assumption& a : assumptions) list.push_back({{"code", a.code}, {"text", a.text}});
  return list;
}

// Reports of versions that told nobody what they assumed have no such member.
Assumptions ReadAssumptions(const OrderedJson& report) {
  Assumptions assumptions;
  for (const OrderedJson& a : report.value("assumptions", OrderedJson::array())) {
    assumptions.push_back({a.at("code").get<std::string>(), a.at("text").get<std::string>()});
  }
  return assumptions;
}

OrderedJson ToJson(const HorizonStatistics& s, std::int64_t horizon_edges) {
  return {{"terrain_edges", s.terrain_edges},
          {"horizon_edges", horizon_edges},
          {"approximate", s.undecided > 0},
          {"undecided", s.undecided},
          {"work_budget", s.work_budget},
          {"candidates", s.candidates},
          {"peaks", s.peaks},
          {"clusters_max", s.clusters_max},
          {"events",
           {{"peak", s.peaks},
            {"regular", s.regular},
            {"saddle", s.saddles},
            {"minimum", s.minima},
            {"merge", s.merges},
            {"hull", s.hull_changes},
            {"bitangent", s.bitangents}}},
          {"queue_max", s.queue_max},
          {"predicates",
           {{"filtered", s.predicates.filtered},
            {"exact", s.predicates.exact},
            {"tied", s.predicates.tied}}}};
}

void ReadHorizon(const OrderedJson& json, Report& report) {
  HorizonStatistics& s = report.statistics;
  json.at("horizon_edges").get_to(report.horizon_edges);
  if (json.contains("edges_in_context")) {
    report.edges_in_context = json.at("edges_in_context").get<std::int64_t>();
  }
  json.at("terrain_edges").get_to(s.terrain_edges);
  // Reports of versions without a budget have neither.
  s.undecided = json.value("undecided", std::int64_t{0});
  s.work_budget = json.value("work_budget", std::int64_t{0});
  json.at("candidates").get_to(s.candidates);
  json.at("peaks").get_to(s.peaks);
  json.at("clusters_max").get_to(s.clusters_max);
  const OrderedJson& events = json.at("events");
  events.at("regular").get_to(s.regular);
  events.at("saddle").get_to(s.saddles);
  events.at("minimum").get_to(s.minima);
  events.at("merge").get_to(s.merges);
  events.at("hull").get_to(s.hull_changes);
  events.at("bitangent").get_to(s.bitangents);
  json.at("queue_max").get_to(s.queue_max);
  const OrderedJson& predicates = json.at("predicates");
  predicates.at("filtered").get_to(s.predicates.filtered);
  predicates.at("exact").get_to(s.predicates.exact);
  predicates.at("tied").get_to(s.predicates.tied);
}

OrderedJson ToJson(const LevelAsked& asked) {
  if (asked.triangles > 0) return {{"triangles", asked.triangles}};
  return {{"vertical_m", asked.vertical_m}, {"silhouette_m", asked.silhouette_m}};
}

LevelAsked ReadAsked(const OrderedJson& json) {
  LevelAsked asked;
  if (json.contains("triangles")) {
    json.at("triangles").get_to(asked.triangles);
  } else {
    json.at("vertical_m").get_to(asked.vertical_m);
    json.at("silhouette_m").get_to(asked.silhouette_m);
  }
  return asked;
}

OrderedJson ToJson(const SkylineEdgesReport& edges) {
  return {{"edges", edges.edges},
          {"carrying", edges.carrying},
          {"share", edges.share},
          {"bytes", edges.bytes}};
}

// Reports of versions that flagged none but the DEM's edges have no such member.
SkylineEdgesReport ReadSkylineEdges(const OrderedJson& level) {
  SkylineEdgesReport edges;
  if (!level.contains("skyline_edges")) return edges;
  const OrderedJson& json = level.at("skyline_edges");
  json.at("edges").get_to(edges.edges);
  json.at("carrying").get_to(edges.carrying);
  json.at("share").get_to(edges.share);
  json.at("bytes").get_to(edges.bytes);
  return edges;
}

OrderedJson ToJson(const LevelReport& level) {
  return {{"level", level.level},
          {"exact", level.exact},
          {"triangles", level.triangles},
          {"vertices", level.vertices},
          {"horizon_edges", level.horizon_edges},
          {"asked", ToJson(level.asked)},
          {"vertical_error_m", ToJson(level.vertical)},
          {"silhouette_error_m", ToJson(level.silhouette, level.rim_m)},
          {"facet_angle_deg", level.facet_angle_deg},
          {"needle_share", level.needle_share},
          {"geometric_error_m", level.geometric_error_m},
          {"quantization_step_m", level.quantization_step_m},
          {"side_step_m", level.side_step_m},
          {"seam_reach", level.seam_reach},
          {"skirt_m", level.skirt_m},
          {"skirt_triangles", level.skirt_triangles},
          {"parts", {1 << level.parts.columns, 1 << level.parts.rows}},
          {"glb_bytes", level.glb_bytes},
          {"drc_bytes", level.drc_bytes},
          {"skyline_edges", ToJson(level.skyline_edges)}};
}

Error BadReport(const std::string& what) {
  return {ErrorCode::kUnsupportedData, "report.json: " + what, "bad-report"};
}

// How often a side is halved that has so many pieces; nullopt where no level's is.
std::optional<int> HalvingsOf(int pieces) {
  for (int depth = 0; depth <= kMostPartDepth; ++depth) {
    if (1 << depth == pieces) return depth;
  }
  return std::nullopt;
}

Result<LevelReport> ReadLevel(const OrderedJson& json) {
  LevelReport level;
  json.at("level").get_to(level.level);
  json.at("exact").get_to(level.exact);
  json.at("triangles").get_to(level.triangles);
  json.at("vertices").get_to(level.vertices);
  json.at("horizon_edges").get_to(level.horizon_edges);
  level.asked = ReadAsked(json.at("asked"));
  level.vertical = ReadMeasure(json.at("vertical_error_m"));
  level.silhouette = ReadMeasure(json.at("silhouette_error_m"));
  json.at("silhouette_error_m").at("rim").get_to(level.rim_m);
  json.at("facet_angle_deg").get_to(level.facet_angle_deg);
  json.at("needle_share").get_to(level.needle_share);
  json.at("geometric_error_m").get_to(level.geometric_error_m);
  json.at("quantization_step_m").get_to(level.quantization_step_m);
  json.at("side_step_m").get_to(level.side_step_m);
  // Reports of versions without aprons and skirts have none of these.
  level.seam_reach = json.value("seam_reach", 0);
  level.skirt_m = json.value("skirt_m", 0.0);
  level.skirt_triangles = json.value("skirt_triangles", std::int64_t{0});
  // Reports of versions that cut no level have no such member.
  const auto pieces = json.value("parts", std::array<int, 2>{1, 1});
  const std::optional<int> columns = HalvingsOf(pieces[0]);
  const std::optional<int> rows = HalvingsOf(pieces[1]);
  if (!columns || !rows) return BadReport("no level has such parts");
  level.parts = {*columns, *rows};
  json.at("glb_bytes").get_to(level.glb_bytes);
  json.at("drc_bytes").get_to(level.drc_bytes);
  level.skyline_edges = ReadSkylineEdges(json);
  return level;
}

OrderedJson ToJson(const FrameReport& frame) {
  return {{"axes", FrameText(frame.axes)}, {"transform", frame.transform}};
}

Result<FrameReport> ReadFrame(const OrderedJson& json) {
  const auto text = json.at("axes").get<std::string>();
  const std::optional<FrameChoice> axes = FrameFromText(text);
  if (!axes) return BadReport("there is no frame \"" + text + "\"");
  return FrameReport{*axes, json.at("transform").get<std::array<double, 16>>()};
}

}  // namespace

std::string WriteReport(const Report& report) {
  OrderedJson levels = OrderedJson::array();
  for (const LevelReport& level : report.levels) levels.push_back(ToJson(level));
  OrderedJson json = {{"farhorizon", report.version},
                      {"dem", ToJson(report.dem)},
                      {"assumptions", ToJson(report.assumptions)},
                      {"horizon", ToJson(report.statistics, report.horizon_edges)},
                      {"levels", levels}};
  if (report.edges_in_context) json["horizon"]["edges_in_context"] = *report.edges_in_context;
  if (report.frame) json["frame"] = ToJson(*report.frame);
  return json.dump(1) + "\n";
}

Result<Report> ReadReport(const std::string& text) {
  try {
    const OrderedJson json = OrderedJson::parse(text);
    Report report;
    json.at("farhorizon").get_to(report.version);
    report.dem = ReadDemReport(json.at("dem"));
    if (json.contains("frame")) {
      Result<FrameReport> frame = ReadFrame(json.at("frame"));
      if (!frame) return std::move(frame.error());
      report.frame = *frame;
    }
    report.assumptions = ReadAssumptions(json);
    ReadHorizon(json.at("horizon"), report);
    for (const OrderedJson& json_of_level : json.at("levels")) {
      Result<LevelReport> level = ReadLevel(json_of_level);
      if (!level) return std::move(level.error());
      report.levels.push_back(*std::move(level));
    }
    return report;
  } catch (const nlohmann::json::exception& failure) {
    return BadReport(failure.what());
  }
}

double RoundUp(double value) { return std::ceil(value * 1e6) / 1e6; }

}  // namespace farhorizon
