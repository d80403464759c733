// The inputs of terrain-lod are the parameters of POST /jobs in proto/openapi.yaml, which tests
// hold to what the program takes; so there is no second list of them.
#include "service/handlers/processes.h"

#include <algorithm>
#include <array>
#include <utility>

#include "core/io/media_type.h"
#include "service/handlers/api_document.h"
#include "service/handlers/echo_inputs.h"

namespace farhorizon {

namespace {

using nlohmann::ordered_json;

constexpr int kMostLevels = 12;  // as proto/openapi.yaml says of `levels`

constexpr std::pair<const char*, const char*> kArtifacts[] = {
    {"tileset.json", "3D Tiles 1.1: a tile for each level, coarsest at the root"},
    {"horizon.geojson", "The horizon edges of the DEM"},
    {"horizon.fgb", "The same as FlatGeobuf, with flatgeobuf among the formats"},
    {"horizon.gpkg", "The same as a GeoPackage, with geopackage among the formats"},
    {"layer.json",
     "The list of terrain tiles, with quantized-mesh among the formats; the tiles are "
     "outputs beside it, terrain-Z-X-Y.terrain"},
    {"report.json", "What was read, found and measured"},
    {"report.html", "The same for people, with pictures"},
    {"manifest.json", "Every artifact: name, media type, bytes, sha256"}};

constexpr std::pair<const char*, const char*> kLevelArtifacts[] = {
    {".glb", "The mesh of a level, glTF 2.0 with Draco"},
    {"-horizon.glb", "The horizon of a level as lines"},
    {".drc", "The mesh of a level as a Draco bitstream"}};

ordered_json ArtifactOutput(const std::string& name, const char* description) {
  const std::string media = MediaTypeOf(name);
  ordered_json schema = {{"type", "object"}, {"contentMediaType", media}};
  if (media.find("json") == std::string::npos) {
    schema["type"] = "string";
    if (media != "text/html") schema["contentEncoding"] = "binary";
  }
  return {{"title", name}, {"description", description}, {"schema", schema}};
}

ordered_json TerrainOutputs() {
  ordered_json outputs = ordered_json::object();
  for (const auto& [name, description] : kArtifacts) {
    outputs[name] = ArtifactOutput(name, description);
  }
  for (int level = 0; level < kMostLevels; ++level) {
    for (const auto& [ending, description] : kLevelArtifacts) {
      const std::string name = "lod" + std::to_string(level) + ending;
      outputs[name] = ArtifactOutput(name, description);
    }
  }
  return outputs;
}

ordered_json DemInput() {
  ordered_json kinds = ordered_json::array();
  for (const char* media : {"image/tiff; application=geotiff", "application/octet-stream",
                            "text/plain", "application/zip"}) {
    kinds.push_back(
        {{"type", "string"}, {"contentEncoding", "base64"}, {"contentMediaType", media}});
  }
  return {{"title", "DEM"},
          {"description",
           "One band of heights, in base64: a file of a format that is told by its "
           "first bytes, or by the name that `filename` gives it"},
          {"minOccurs", 1},
          {"maxOccurs", 1},
          {"schema", {{"oneOf", kinds}}}};
}

ordered_json TerrainInputs() {
  ordered_json inputs = {{"dem", DemInput()}};
  for (const ordered_json& parameter : JobParameters()) {
    if (parameter["in"] != "query") continue;
    inputs[parameter["name"].get<std::string>()] = {{"title", parameter["name"]},
                                                    {"description", parameter["description"]},
                                                    {"minOccurs", 0},
                                                    {"schema", SchemaOf30(parameter["schema"])}};
  }
  return inputs;
}

ordered_json TerrainSummary() {
  return {{"id", kTerrainProcess},
          {"version", "1.0.0"},
          {"title", "DEM to levels of detail that keep its skyline"},
          {"description",
           "Turns an elevation grid into streamable levels of detail whose distant skyline is "
           "exactly that of the original"},
          {"keywords", {"DEM", "terrain", "level of detail", "horizon", "3D Tiles"}},
          {"jobControlOptions", {"async-execute", "dismiss"}},
          {"outputTransmission", {"reference", "value"}}};
}

ordered_json EchoSummary() {
  return {{"id", kEchoProcess},
          {"version", "1.0.0"},
          {"title", "Echo"},
          {"description", "Gives back what it is sent, for tests of clients and of this service"},
          {"keywords", {"test"}},
          {"jobControlOptions", {"sync-execute", "async-execute", "dismiss"}},
          {"outputTransmission", {"value", "reference"}}};
}

// Whether it is "terrain-Z-X-Y.terrain".
bool IsTerrainTile(std::string_view name) {
  constexpr std::string_view kStart = "terrain-";
  constexpr std::string_view kEnd = ".terrain";
  if (!name.starts_with(kStart) || !name.ends_with(kEnd)) return false;
  name.remove_prefix(kStart.size());
  name.remove_suffix(std::min(kEnd.size(), name.size()));
  return name.find_first_not_of("0123456789-") == std::string_view::npos;
}

}  // namespace

std::vector<std::string> ProcessNames(const HandlerContext& context) {
  std::vector<std::string> names = {kTerrainProcess};
  if (context.echo) names.emplace_back(kEchoProcess);
  return names;
}

bool IsOffered(const HandlerContext& context, std::string_view process) {
  const std::vector<std::string> names = ProcessNames(context);
  return std::find(names.begin(), names.end(), process) != names.end();
}

ordered_json ProcessSummary(const std::string& process, const std::string& base) {
  ordered_json summary = process == kEchoProcess ? EchoSummary() : TerrainSummary();
  const std::string self = base + "/processes/" + process;
  summary["links"] = {{{"rel", "self"}, {"type", "application/json"}, {"href", self}},
                      {{"rel", "http://www.opengis.net/def/rel/ogc/1.0/execute"},
                       {"type", "application/json"},
                       {"title", "POST here executes the process"},
                       {"href", self + "/execution"}}};
  return summary;
}

ordered_json ProcessDescription(const std::string& process, const std::string& base) {
  ordered_json description = ProcessSummary(process, base);
  const bool echo = process == kEchoProcess;
  description["inputs"] = echo ? EchoInputs() : TerrainInputs();
  description["outputs"] = echo ? EchoOutputs() : TerrainOutputs();
  return description;
}

bool MayHaveOutput(std::string_view process, std::string_view output) {
  if (process == kEchoProcess) return EchoOutputs().contains(std::string(output));
  return TerrainOutputs().contains(std::string(output)) || IsTerrainTile(output);
}

}  // namespace farhorizon
