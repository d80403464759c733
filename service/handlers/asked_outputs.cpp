#include "service/handlers/asked_outputs.h"

#include <charconv>

#include "core/io/media_type.h"
#include "service/handlers/http_message.h"
#include "service/handlers/problem.h"
#include "service/handlers/processes.h"

namespace farhorizon {

namespace {

using nlohmann::json;

// The format among `formats` without which there is no such output; null where it always is.
const char* FormatOf(std::string_view output) {
  if (output.ends_with("-horizon.glb")) return nullptr;
  if (output == "tileset.json" || output.ends_with(".glb")) return "3dtiles";
  if (output.ends_with(".drc")) return "drc";
  if (output.ends_with(".geojson")) return "geojson";
  if (output.ends_with(".fgb")) return "flatgeobuf";
  if (output.ends_with(".gpkg")) return "geopackage";
  if (output == "layer.json" || output.ends_with(".terrain")) return "quantized-mesh";
  return nullptr;
}

// The level of "lodN…"; nullopt for what is of no level.
std::optional<int> LevelOf(std::string_view output) {
  if (!output.starts_with("lod")) return std::nullopt;
  int level = 0;
  const auto [end, failure] =
      std::from_chars(output.data() + 3, output.data() + output.size(), level);
  return failure == std::errc() ? std::optional(level) : std::nullopt;
}

Status CheckFormat(const std::string& name, const json& how) {
  const auto format = how.find("format");
  if (format == how.end() || !format->is_object() || !format->contains("mediaType")) return Ok{};
  const json& asked = (*format)["mediaType"];
  const std::string own = MediaTypeOf(name);
  if (asked.is_string() && MediaTypeIn(asked.get<std::string>()) == MediaTypeIn(own)) return Ok{};
  return InvalidParameter("the output " + name + " is " + own + ", and of no other mediaType");
}

}  // namespace

Result<AskedOutputs> ReadAskedOutputs(const json& request, std::string_view process) {
  if (!request.contains("outputs")) return AskedOutputs();
  if (!request["outputs"].is_object()) return InvalidParameter("outputs must be an object");
  AskedOutputs asked;
  asked.emplace();
  for (const auto& [name, how] : request["outputs"].items()) {
    if (!MayHaveOutput(process, name)) {
      return InvalidParameter("the process has no output \"" + name.substr(0, 100) +
                              "\"; its description lists all");
    }
    if (!how.is_object())
      return InvalidParameter("an output is asked for by an object, which may be empty");
    if (process == kTerrainProcess) {
      if (Status fits = CheckFormat(name, how); !fits) return std::move(fits.error());
    }
    std::optional<Transmission>& mode = (*asked)[name];
    if (!how.contains("transmissionMode")) continue;
    const json& word = how["transmissionMode"];
    if (word != "value" && word != "reference") {
      return InvalidParameter("transmissionMode must be value or reference");
    }
    mode = word == "value" ? Transmission::kValue : Transmission::kReference;
  }
  return asked;
}

Status CheckOutputsOf(const ResultWishes& wishes, const BuildOptions& options) {
  if (!wishes.outputs) return Ok{};
  const std::size_t most = options.triangles.empty() ? static_cast<std::size_t>(options.levels)
                                                     : options.triangles.size();
  for (const auto& [name, how] : *wishes.outputs) {
    const char* const format = FormatOf(name);
    if (format != nullptr && !Asks(options, format)) {
      return InvalidParameter("there is no output " + name + " without " + format +
                              " among the formats");
    }
    const std::optional<int> level = LevelOf(name);
    if (level && static_cast<std::size_t>(*level) >= most) {
      return InvalidParameter("there is no output " + name +
                              ": the levels that are asked for are " + std::to_string(most) +
                              ", from 0 on");
    }
  }
  return Ok{};
}

}  // namespace farhorizon
