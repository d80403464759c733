// For programs: each name says its unit, each figure is rounded to what does not differ between
// machines, and a mesh that could not be measured has its fault in place of figures.
#include "core/pipeline/compare/comparison_json.h"

#include <cmath>

#include <nlohmann/json.hpp>

#include "core/pipeline/compare/level_summary.h"
#include "core/pipeline/version.h"

namespace farhorizon {

namespace {

using OrderedJson = nlohmann::ordered_json;

// Six digits tell more than any error is known; full doubles would only differ between machines.
double Short(double value) {
  if (value == 0 || !std::isfinite(value)) return value;
  const double unit = std::pow(10.0, std::floor(std::log10(std::abs(value))) - 5);
  return std::round(value / unit) * unit;
}

OrderedJson Measure(const ErrorMeasure& measure) {
  return {{"max", Short(measure.max_m)}, {"rms", Short(measure.rms_m)}};
}

OrderedJson MeshJsonOf(const MeshComparison& mesh) {
  OrderedJson json = {{"name", mesh.name}};
  if (mesh.depth) json["depth"] = *mesh.depth;
  if (mesh.geometric_error_m) json["geometric_error_m"] = *mesh.geometric_error_m;
  if (mesh.fault) {
    json["fault"] = *mesh.fault;
    return json;
  }
  const MeshError& e = mesh.error;
  json["triangles"] = mesh.triangles;
  json["vertices"] = mesh.vertices;
  json["placing"] = mesh.placing;
  json["covered_posts"] = mesh.posts;
  json["covered_share"] = Short(mesh.covered_share);
  json["compared_in_part"] = mesh.in_part;
  json["posts_without_data"] = mesh.posts_without_data;
  json["vertical_error_m"] = Measure(e.vertical);
  json["vertical_error_m"]["mean"] = Short(mesh.mean_error_m);
  json["silhouette_error_m"] = Measure(e.silhouette);
  json["silhouette_error_m"]["rim"] = Short(e.rim_m);
  json["silhouette_error_m"]["sampled_max"] = Short(e.sampled_max_m);
  json["facet_angle_rms_deg"] = Short(e.facet_angle_rms_deg);
  json["needle_share"] = Short(e.needle_share);
  json["correlation"] = Short(mesh.correlation);
  json["skirt_triangles"] = mesh.skirt_triangles;
  json["polygons"] = mesh.polygons;
  json["turned"] = mesh.turned;
  json["sound"] = !mesh.IsUnsound();
  json["defects"] = {{"flipped", e.defects.flipped},
                     {"covered_twice", e.defects.covered_twice},
                     {"crowded_edges", e.defects.crowded_edges},
                     {"hole_posts", mesh.hole_posts},
                     {"open_edges", e.defects.open_edges}};
  return json;
}

OrderedJson LevelJsonOf(const LevelSummary& level) {
  return {
      {"depth", level.depth},
      {"tiles", level.tiles},
      {"triangles", level.triangles},
      {"vertices", level.vertices},
      {"vertical_error_m", Measure(level.vertical)},
      {"silhouette_error_m", {{"max", Short(level.silhouette_max_m)}, {"rim", Short(level.rim_m)}}},
      {"facet_angle_rms_deg", Short(level.facet_angle_rms_deg)},
      {"needle_share", Short(level.needle_share)}};
}

}  // namespace

std::string ComparisonJson(const Comparison& comparison) {
  const DemReport& dem = comparison.dem;
  OrderedJson json;
  json["farhorizon"] = Version();
  json["dem"] = {{"name", comparison.dem_name},
                 {"columns", dem.columns},
                 {"rows", dem.rows},
                 {"crs", dem.crs},
                 {"cell_m", dem.cell_m},
                 {"heights_m", dem.heights_m},
                 {"nodata_posts", dem.nodata_posts},
                 {"sha256", dem.sha256}};
  json["assumptions"] = OrderedJson::array();
  for (const Assumption& a : comparison.assumptions) {
    json["assumptions"].push_back({{"code", a.code}, {"text", a.text}});
  }
  json["meshes"] = OrderedJson::array();
  for (const MeshComparison& mesh : comparison.meshes) json["meshes"].push_back(MeshJsonOf(mesh));
  json["levels"] = OrderedJson::array();
  for (const LevelSummary& level : SummarizeLevels(comparison.meshes)) {
    json["levels"].push_back(LevelJsonOf(level));
  }
  return json.dump(2, ' ', false, OrderedJson::error_handler_t::replace) + "\n";
}

}  // namespace farhorizon
