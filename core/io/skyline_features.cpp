#include "core/io/skyline_features.h"

#include "core/io/geojson_text.h"

namespace farhorizon {

namespace {

std::string Metres(const std::array<double, 2>& pair) {
  return Bracketed({Rounded(pair[0], kMetreDecimals), Rounded(pair[1], kMetreDecimals)});
}

std::string PartText(const SkylineFeature& part) {
  std::string text = R"({"type":"Feature","geometry":)" + LineGeometry(part.left, part.right);
  text += R"(,"properties":{"a":)" + Pair(part.a[0], part.a[1]);
  text += R"(,"b":)" + Pair(part.b[0], part.b[1]);
  text += R"(,"t":)" + Bracketed({Exact(part.t[0]), Exact(part.t[1])});
  text += R"(,"offset_m":)" + Metres(part.offset_m);
  text += R"(,"depth_m":)" + Metres(part.depth_m);
  return text + "}}";
}

}  // namespace

std::string WriteSkylineGeoJson(const SkylineOfDirection& skyline) {
  std::string text = R"({"type":"FeatureCollection","azimuth":)" + Exact(skyline.azimuth);
  text += R"(,"direction":)" + Pair(skyline.direction[0], skyline.direction[1]);
  if (skyline.approximate) text += R"(,"approximate":true)";
  text += R"(,"features":[)";
  const char* separator = "\n";
  for (const SkylineFeature& part : skyline.parts) {
    text += separator + PartText(part);
    separator = ",\n";
  }
  return text + "\n]}\n";
}

}  // namespace farhorizon
