// The text is put together by hand: numbers are rounded to decimals and printed without exponents
// or trailing zeros, which nlohmann's dump does not do ("1e-06", "5.0"), one feature to a line.
#include "core/io/horizon_features.h"

#include <algorithm>
#include <utility>

#include <nlohmann/json.hpp>

#include "core/io/geojson_text.h"

namespace farhorizon {

namespace {

// Decimals of angular_share and line_measure_m.
constexpr int kMeasureDecimals = 9;
// A skyline drop is known to half a millimetre (kSkylineDropStep).
constexpr int kSkylineDropDecimals = 3;

std::string WitnessText(const Witness& witness) {
  if (!witness.exact) return R"(,"witness":null,"too_narrow":true)";
  return R"(,"witness":{"t":)" + Exact(witness.t) + R"(,"direction":)" +
         Pair(witness.dc, witness.dr) + "}";
}

// The property `name`, after others: null where it was not afforded, nothing where not asked for.
std::string Measure(const char* name, Known known, const std::string& value) {
  if (known == Known::kNotAsked) return {};
  return ",\"" + std::string(name) + "\":" + (known == Known::kYes ? value : "null");
}

std::string MeasuresText(const EdgeMeasures& m) {
  return Measure("azimuths", m.sights, IntervalsText(m.azimuths, kAzimuthDecimals)) +
         Measure("spans", m.sights, IntervalsText(m.spans, kSpanDecimals)) +
         Measure("angular_share", m.sights, Rounded(m.angular_share, kMeasureDecimals)) +
         Measure("line_measure_m", m.sights, Rounded(m.line_measure_m, kMeasureDecimals)) +
         Measure("skyline_drop_m", m.drop, Rounded(m.skyline_drop_m, kSkylineDropDecimals));
}

std::string FeatureText(const HorizonFeature& feature) {
  std::string text = R"({"type":"Feature","geometry":)" + LineGeometry(feature.from, feature.to);
  text += R"(,"properties":{"a":)" + Pair(feature.a[0], feature.a[1]);
  text += R"(,"b":)" + Pair(feature.b[0], feature.b[1]);
  if (feature.undecided) {
    text += R"(,"undecided":true)";
  } else {
    text += MeasuresText(feature.measures) + WitnessText(feature.witness);
  }
  if (feature.level_kept) text += R"(,"level_kept":)" + std::to_string(*feature.level_kept);
  if (feature.in_context) text += ContextText(*feature.in_context);
  return text + "}}";
}

using Json = nlohmann::json;

Geodetic ReadPosition(const Json& position) {
  return {position.at(0).get<double>(), position.at(1).get<double>(), position.at(2).get<double>()};
}

// The ends of a line, whether it is cut or not.
std::array<Geodetic, 2> ReadLine(const Json& geometry) {
  const Json& lines = geometry.at("coordinates");
  if (geometry.at("type") == "LineString") {
    return {ReadPosition(lines.at(0)), ReadPosition(lines.at(1))};
  }
  return {ReadPosition(lines.at(0).at(0)), ReadPosition(lines.at(1).at(1))};
}

Witness ReadWitness(const Json& properties) {
  Witness result;
  result.exact = !properties.value("too_narrow", false);
  if (!result.exact) return result;
  const Json& witness = properties.at("witness");
  result.t = witness.at("t").get<double>();
  const auto direction = witness.at("direction").get<std::array<std::int64_t, 2>>();
  result.dc = direction[0];
  result.dr = direction[1];
  return result;
}

Known KnownOf(const Json& properties, const char* name) {
  const auto found = properties.find(name);
  if (found == properties.end()) return Known::kNotAsked;
  return found->is_null() ? Known::kNotAfforded : Known::kYes;
}

EdgeMeasures ReadMeasures(const Json& properties) {
  EdgeMeasures measures;
  measures.sights = KnownOf(properties, "azimuths");
  measures.drop = KnownOf(properties, "skyline_drop_m");
  if (measures.sights == Known::kYes) {
    measures.azimuths = properties.at("azimuths").get<std::vector<std::array<double, 2>>>();
    measures.spans = properties.at("spans").get<std::vector<std::array<double, 2>>>();
    measures.angular_share = properties.at("angular_share").get<double>();
    measures.line_measure_m = properties.at("line_measure_m").get<double>();
  }
  if (measures.drop == Known::kYes) {
    measures.skyline_drop_m = properties.at("skyline_drop_m").get<double>();
  }
  return measures;
}

HorizonFeature ReadFeature(const Json& feature) {
  const std::array<Geodetic, 2> line = ReadLine(feature.at("geometry"));
  const Json& properties = feature.at("properties");
  HorizonFeature result{};
  result.a = properties.at("a").get<std::array<std::int32_t, 2>>();
  result.b = properties.at("b").get<std::array<std::int32_t, 2>>();
  result.from = line[0];
  result.to = line[1];
  result.undecided = properties.value("undecided", false);
  if (result.undecided) {
    result.measures.sights = result.measures.drop = Known::kNotAfforded;
  } else {
    result.measures = ReadMeasures(properties);
    result.witness = ReadWitness(properties);
  }
  if (properties.contains("level_kept")) {
    result.level_kept = properties.at("level_kept").get<int>();
  }
  if (properties.contains("context")) result.in_context = properties.at("context").get<bool>();
  return result;
}

Error BadGeoJson(const std::string& message) {
  return {ErrorCode::kUnsupportedData, "no horizon.geojson: " + message, "bad-geojson"};
}

}  // namespace

std::string ContextText(bool in_context) {
  return std::string(R"(,"context":)") + (in_context ? "true" : "false");
}

std::string IntervalsText(const std::vector<std::array<double, 2>>& intervals, int decimals) {
  std::string text(1, '[');
  for (const auto& [from, to] : intervals) {
    if (text.size() > 1) text += ',';
    text += Bracketed({Rounded(from, decimals), Rounded(to, decimals)});
  }
  return text += ']';
}

std::string WriteHorizonGeoJson(const std::vector<HorizonFeature>& features) {
  const auto undecided = std::count_if(features.begin(), features.end(),
                                       [](const HorizonFeature& f) { return f.undecided; });
  std::string text = R"({"type":"FeatureCollection",)";
  if (undecided > 0) {
    text += R"("approximate":true,"undecided":)" + std::to_string(undecided) + ",";
  }
  text += R"("features":[)";
  const char* separator = "\n";
  for (const HorizonFeature& feature : features) {
    text += separator + FeatureText(feature);
    separator = ",\n";
  }
  return text + "\n]}\n";
}

Result<std::vector<HorizonFeature>> ReadHorizonGeoJson(const std::string& text) {
  std::vector<HorizonFeature> features;
  try {
    const Json collection = Json::parse(text);
    if (collection.at("type") != "FeatureCollection") return BadGeoJson("no FeatureCollection");
    for (const Json& feature : collection.at("features")) features.push_back(ReadFeature(feature));
    return features;
  } catch (const Json::exception& failure) {
    return BadGeoJson("feature " + std::to_string(features.size()) + ": " + failure.what());
  }
}

}  // namespace farhorizon
