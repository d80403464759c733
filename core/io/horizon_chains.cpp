// Text that is put together by hand, for the reasons that horizon_features.cpp has. A chain is its
// line alone, to save bytes: its posts are the nearest to its points, and edges follow from those.
#include "core/io/horizon_chains.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstddef>
#include <string_view>
#include <utility>

#include <nlohmann/json.hpp>

#include "core/io/antimeridian.h"
#include "core/io/geojson_text.h"
#include "core/io/join_edges.h"

namespace farhorizon {

namespace {

using Post = std::array<std::int32_t, 2>;

constexpr char kHead[] = R"({"type":"FeatureCollection","detail":"chains",)";
constexpr std::string_view kLevelDigits = "0123456789abcdef";
constexpr int kWeightDigits = 4;
// Coordinates are rounded to less than the cell's size over this: no one sees it.
constexpr double kPartOfCell = 64;
constexpr double kMetresADegree = 111320;

Known Both(Known a, Known b) {
  if (a == Known::kNotAsked || b == Known::kNotAsked) return Known::kNotAsked;
  return a == Known::kYes ? b : a;
}

void Append(const HorizonFeature& edge, bool reversed, HorizonChain& chain) {
  if (chain.posts.empty()) {
    chain.posts.push_back(reversed ? edge.b : edge.a);
    chain.line.push_back(reversed ? edge.to : edge.from);
  }
  chain.posts.push_back(reversed ? edge.a : edge.b);
  chain.line.push_back(reversed ? edge.from : edge.to);
  chain.level_kept.push_back(edge.level_kept);
  chain.in_context = edge.in_context;
  chain.undecided = edge.undecided;
  const EdgeMeasures& m = edge.measures;
  chain.sights = Both(chain.sights, m.sights);
  chain.drop = Both(chain.drop, m.drop);
  chain.azimuths |= MaskOf(m.azimuths);
  chain.line_measure_m += m.line_measure_m;
  chain.skyline_drop_m = std::max(chain.skyline_drop_m, m.skyline_drop_m);
}

int DecimalsFor(double step) { return std::max(0, static_cast<int>(std::ceil(-std::log10(step)))); }

// Four digits; the text of JSON's numbers may have an exponent.
std::string Weight(double value) {
  std::array<char, 32> text{};
  const auto end = std::to_chars(text.data(), text.data() + text.size(), value,
                                 std::chars_format::general, kWeightDigits);
  return {text.data(), end.ptr};
}

std::string Position(const Geodetic& g, const ChainRounding& rounding) {
  return Bracketed({Rounded(g.lon_deg, rounding.degree_decimals),
                    Rounded(g.lat_deg, rounding.degree_decimals),
                    Rounded(g.height_m, rounding.metre_decimals)});
}

// A LineString, or where the meridian of 180 degrees cuts the line a MultiLineString of its parts.
std::string Geometry(const std::vector<Geodetic>& line, const ChainRounding& rounding) {
  std::vector<std::string> parts = {Position(line.front(), rounding)};
  for (std::size_t i = 0; i + 1 < line.size(); ++i) {
    const auto pieces = CutAtAntimeridian(line[i], line[i + 1]);
    parts.back() += "," + Position(pieces.front()[1], rounding);
    for (std::size_t k = 1; k < pieces.size(); ++k) {
      parts.push_back(Position(pieces[k][0], rounding) + "," + Position(pieces[k][1], rounding));
    }
  }
  std::string text;
  for (const std::string& part : parts) text += (text.empty() ? "[" : ",[") + part + "]";
  if (parts.size() == 1) return R"({"type":"LineString","coordinates":)" + text + "}";
  return R"({"type":"MultiLineString","coordinates":[)" + text + "]}";
}

std::string Property(const char* name, Known known, const std::string& value) {
  if (known == Known::kNotAsked) return {};
  return ",\"" + std::string(name) + "\":" + (known == Known::kYes ? value : "null");
}

std::string FeatureText(const HorizonChain& chain, const ChainRounding& rounding) {
  std::string properties;
  if (chain.undecided) {
    properties += R"(,"undecided":true)";
  } else {
    properties += Property("azimuths", chain.sights, '"' + MaskText(chain.azimuths) + '"') +
                  Property("line_measure_m", chain.sights, Weight(chain.line_measure_m)) +
                  Property("skyline_drop_m", chain.drop, Weight(chain.skyline_drop_m));
  }
  const bool levels = std::ranges::any_of(chain.level_kept, [](const auto& l) { return !!l; });
  if (levels) {
    properties += R"(,"levels_kept":")";
    for (const std::optional<int>& level : chain.level_kept) {
      properties += level ? kLevelDigits[static_cast<std::size_t>(*level)] : '-';
    }
    properties += '"';
  }
  if (chain.in_context) properties += ContextText(*chain.in_context);
  if (!properties.empty()) properties.front() = '{';
  return R"({"type":"Feature","geometry":)" + Geometry(chain.line, rounding) + R"(,"properties":)" +
         (properties.empty() ? "{" : properties) + "}}";
}

using Json = nlohmann::json;

std::vector<Geodetic> ReadChainLine(const Json& geometry) {
  const Json& coordinates = geometry.at("coordinates");
  const bool whole = geometry.at("type") == "LineString";
  std::vector<Geodetic> line;
  for (const Json& part : whole ? Json::array({coordinates}) : coordinates) {
    // Where a line is cut it has the place of the cut twice, and no post.
    if (!line.empty()) line.pop_back();
    bool cut = !line.empty();
    for (const Json& p : part) {
      if (!std::exchange(cut, false)) {
        line.push_back({p.at(0).get<double>(), p.at(1).get<double>(), p.at(2).get<double>()});
      }
    }
  }
  return line;
}

Known KnownOfChain(const Json& properties, const char* name) {
  const auto found = properties.find(name);
  if (found == properties.end()) return Known::kNotAsked;
  return found->is_null() ? Known::kNotAfforded : Known::kYes;
}

AzimuthMask ReadMask(const std::string& text) {
  AzimuthMask mask = 0;
  for (const char c : text) {
    const std::size_t digit = kLevelDigits.find(c);
    mask = mask << 4U | (digit & 15U);
  }
  return mask;
}

// Throws std::out_of_range where its levels are not those of so many edges.
HorizonChain ReadChain(const Json& feature) {
  const Json& properties = feature.at("properties");
  HorizonChain chain;
  chain.line = ReadChainLine(feature.at("geometry"));
  if (chain.line.size() < 2) throw std::out_of_range("a line has two points");
  chain.level_kept.resize(chain.line.size() - 1);
  if (properties.contains("levels_kept")) {
    const auto levels = properties.at("levels_kept").get<std::string>();
    if (levels.size() != chain.level_kept.size()) throw std::out_of_range("a level an edge");
    for (std::size_t i = 0; i < chain.level_kept.size(); ++i) {
      const std::size_t digit = kLevelDigits.find(levels[i]);
      if (digit != std::string_view::npos) chain.level_kept[i] = static_cast<int>(digit);
    }
  }
  if (properties.contains("context")) chain.in_context = properties.at("context").get<bool>();
  chain.undecided = properties.value("undecided", false);
  if (chain.undecided) {
    chain.sights = chain.drop = Known::kNotAfforded;
    return chain;
  }
  chain.sights = KnownOfChain(properties, "azimuths");
  chain.drop = KnownOfChain(properties, "skyline_drop_m");
  if (chain.sights == Known::kYes) {
    chain.azimuths = ReadMask(properties.at("azimuths").get<std::string>());
    chain.line_measure_m = properties.at("line_measure_m").get<double>();
  }
  if (chain.drop == Known::kYes) {
    chain.skyline_drop_m = properties.at("skyline_drop_m").get<double>();
  }
  return chain;
}

Error BadGeoJson(std::size_t feature, const std::string& message) {
  return {ErrorCode::kUnsupportedData,
          "no chains of horizon.geojson: feature " + std::to_string(feature) + ": " + message,
          "bad-geojson"};
}

}  // namespace

std::vector<HorizonChain> ChainsOf(const std::vector<HorizonFeature>& features) {
  std::vector<PlanEdge> edges;
  edges.reserve(features.size());
  const auto point = [](const Post& p) { return std::array<double, 2>{1.0 * p[0], 1.0 * p[1]}; };
  for (const HorizonFeature& f : features) {
    const int kind = (f.undecided ? 1 : 0) + (f.in_context.value_or(false) ? 2 : 0);
    edges.push_back({point(f.a), point(f.b), kind});
  }
  std::vector<HorizonChain> chains;
  for (const std::vector<ChainedEdge>& links : JoinEdges(edges)) {
    HorizonChain& chain = chains.emplace_back();
    for (const ChainedEdge& link : links) Append(features[link.edge], link.reversed, chain);
  }
  return chains;
}

ChainRounding RoundingOfChains(double cell_m) {
  const double step_m = cell_m / kPartOfCell;
  return {std::min(DecimalsFor(step_m / kMetresADegree), kDegreeDecimals),
          std::min(DecimalsFor(step_m), kMetreDecimals)};
}

std::string WriteHorizonChains(const std::vector<HorizonChain>& chains, double cell_m) {
  std::size_t edges = 0;
  std::size_t undecided = 0;
  AzimuthMask azimuths = 0;
  for (const HorizonChain& chain : chains) {
    edges += chain.level_kept.size();
    undecided += chain.undecided ? chain.level_kept.size() : 0;
    azimuths |= chain.azimuths;
  }
  std::string text = kHead;
  text += R"("edges":)" + std::to_string(edges) + R"(,"azimuths":")" + MaskText(azimuths) + "\",";
  if (undecided > 0) {
    text += R"("approximate":true,"undecided":)" + std::to_string(undecided) + ",";
  }
  text += R"("features":[)";
  const ChainRounding rounding = RoundingOfChains(cell_m);
  const char* separator = "\n";
  for (const HorizonChain& chain : chains) {
    text += separator + FeatureText(chain, rounding);
    separator = ",\n";
  }
  return text + "\n]}\n";
}

bool HasChains(const std::string& text) { return text.starts_with(kHead); }

Result<std::vector<HorizonChain>> ReadHorizonChains(const std::string& text) {
  std::vector<HorizonChain> chains;
  try {
    const Json collection = Json::parse(text);
    for (const Json& feature : collection.at("features")) chains.push_back(ReadChain(feature));
    return chains;
  } catch (const Json::exception& failure) {
    return BadGeoJson(chains.size(), failure.what());
  } catch (const std::out_of_range&) {
    return BadGeoJson(chains.size(), "it is no line, or has other levels than edges");
  }
}

}  // namespace farhorizon
