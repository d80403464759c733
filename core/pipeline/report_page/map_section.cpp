// The pictures are within the page, which asks the network for nothing. So they share a bound of
// bytes, and their quality falls until they keep it; the edges are drawn in sectors of azimuth over
// one of them, that each may be shown or hidden without another picture.
#include "core/pipeline/report_page/map_section.h"

#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <span>
#include <string>
#include <utility>

#include "core/base/result.h"
#include "core/io/base64.h"
#include "core/io/geojson_text.h"
#include "core/io/svg_text.h"
#include "core/pipeline/report_page/azimuth_colours.h"
#include "core/pipeline/report_page/edge_layers.h"
#include "core/pipeline/report_page/figures.h"

namespace farhorizon {

namespace {

// Bytes of all reliefs together, before base64 adds a third: keeps the page below two megabytes
// where the ground is mountains, and near them where it is noise.
constexpr std::size_t kReliefBytes = 1'050'000;

std::string DataUrl(const char* media_type, const std::string& bytes) {
  const auto* const first = reinterpret_cast<const unsigned char*>(bytes.data());
  return std::string("data:") + media_type + ";base64," + ToBase64(std::span(first, bytes.size()));
}

// The best of a few qualities that stays within `most_bytes`, or the least.
Result<std::string> EncodeWithin(const GreyPicture& picture, std::size_t most_bytes) {
  for (const int quality : {80, 65, 50, 35}) {
    Result<std::string> bytes = EncodeJpeg(picture, quality);
    if (!bytes || bytes->size() <= most_bytes) return bytes;
  }
  return EncodeJpeg(picture, 20);
}

std::string SizeOf(const PictureFrame& frame) {
  return " width=\"" + std::to_string(frame.width) + "\" height=\"" + std::to_string(frame.height) +
         "\"";
}

// The layers' pictures, over one another.
Result<Html> EdgePictures(const std::array<EdgeLayer, kSectors + 1>& layers,
                          const PictureFrame& frame) {
  Html html = "<div class=\"edges\">"_html;
  for (std::size_t i = 0; i < layers.size(); ++i) {
    if (layers[i].edges == 0) continue;
    Result<std::string> png = EncodePng(layers[i].picture);
    if (!png) return std::move(png.error());
    html += Html::Markup("<img alt=\"\" data-sector=\"" + std::to_string(i) + "\"" + SizeOf(frame) +
                         " src=\"" + DataUrl("image/png", *png) + "\">");
  }
  return html + "</div>"_html;
}

std::string SubjectOf(std::size_t relief) {
  return relief == 0 ? "DEM" : "Level " + std::to_string(relief - 1);
}

Result<Html> Figure(const MapContents& map, std::size_t relief, const Html& over) {
  Result<std::string> jpeg = EncodeWithin(map.reliefs[relief], kReliefBytes / map.reliefs.size());
  if (!jpeg) return std::move(jpeg.error());
  const std::int64_t triangles =
      relief == 0 ? map.terrain_triangles : map.report.levels[relief - 1].triangles;
  const std::string shows = relief == 0 ? "dem" : std::to_string(relief - 1);
  return Html::Markup("<figure data-shows=\"" + shows + "\"><div class=\"frame\"><img alt=\"" +
                      SubjectOf(relief) + " as shaded relief, north up\"" + SizeOf(map.frame) +
                      " src=\"" + DataUrl("image/jpeg", *jpeg) + "\">") +
         over + "</div><figcaption>"_html +
         Html::Text(SubjectOf(relief) + ": " + Counted(triangles, "triangle", "triangles")) +
         "</figcaption></figure>"_html;
}

Html Choice(std::size_t count) {
  Html html = "<fieldset class=\"choice\" data-for=\"map\"><legend>Show</legend>"_html;
  for (std::size_t i = 0; i < count; ++i) {
    const std::string value = i == 0 ? "dem" : std::to_string(i - 1);
    html += Html::Markup("<label><input type=\"radio\" name=\"map\" value=\"" + value + "\"" +
                         (i == 0 ? " checked" : "") + "><span>" + SubjectOf(i) + "</span></label>");
  }
  return html + "</fieldset>"_html;
}

// A wedge of the wheel, from one azimuth to another.
std::string Wedge(double from_deg, double to_deg) {
  const auto point = [](double azimuth_deg, double radius) {
    const double radians = azimuth_deg * std::numbers::pi / 180;
    return SvgNumber(radius * std::sin(radians)) + " " + SvgNumber(-radius * std::cos(radians));
  };
  // Half a degree over: no seam shows between wedges.
  const double over = to_deg + 0.5;
  return "<path d=\"M" + point(from_deg, 30) + "L" + point(from_deg, 52) + "A52 52 0 0 1 " +
         point(over, 52) + "L" + point(over, 30) + "A30 30 0 0 0 " + point(from_deg, 30) +
         "Z\" fill=\"" + HexOf(ColourOfAzimuth((from_deg + to_deg) / 2)) + "\"/>";
}

// The colours as a compass. It is turned as the map is: true north need not be up.
std::string Wheel(const MapContents& map) {
  const double up_deg = map.step.ToAzimuth(0, map.frame.flips_rows ? 1 : -1);
  std::string wheel =
      "<svg class=\"wheel\" viewBox=\"-74 -74 148 148\" role=\"img\" aria-label=\"Colour by "
      "direction of sight: blue north and south, green north-east, yellow east-north-east, red "
      "east-south-east, purple south-east, and the same on the other side\"><g "
      "transform=\"rotate(" +
      SvgNumber(-up_deg) + ")\">";
  for (int from = 0; from < 360; from += 10) wheel += Wedge(from, from + 10);
  constexpr std::array<std::pair<const char*, std::array<int, 2>>, 4> kLetters = {
      {{"N", {0, -63}}, {"E", {63, 0}}, {"S", {0, 63}}, {"W", {-63, 0}}}};
  for (const auto& [letter, at] : kLetters) {
    wheel += "<text text-anchor=\"middle\" x=\"" + std::to_string(at[0]) + "\" y=\"" +
             std::to_string(at[1] + 5) + "\">" + letter + "</text>";
  }
  return wheel + "</g></svg>";
}

// The colour in a sector's middle, as the legend shows it; grey for undecided edges.
std::string SwatchOf(std::size_t layer) {
  if (layer == kSectors) return "#5a5a5a";
  return HexOf(ColourOfAzimuth(45.0 * static_cast<double>(layer)));
}

Html Legend(const MapContents& map, const std::array<EdgeLayer, kSectors + 1>& layers) {
  double measure = 0;
  for (const EdgeLayer& layer : layers) measure += layer.line_measure_m;
  Html html = Html::Markup(Wheel(map)) +
              "<table class=\"sectors\"><caption>Horizon edges by the direction of sight that sees "
              "them, the middle of their widest range of azimuths</caption><thead><tr>"
              "<th scope=\"col\">Direction</th><th scope=\"col\" class=\"number\">Edges</th>"
              "<th scope=\"col\" class=\"number\">Of all lines</th></tr></thead><tbody>"_html;
  for (std::size_t i = 0; i < layers.size(); ++i) {
    if (i == kSectors && layers[i].edges == 0) continue;
    const std::string name = i == kSectors ? "undecided" : SectorName(static_cast<int>(i));
    html += Html::Markup(
        "<tr><th scope=\"row\"><label><input type=\"checkbox\" checked "
        "data-sector=\"" +
        std::to_string(i) +
        "\"><svg class=\"swatch\" viewBox=\"0 0 10 10\" aria-hidden=\"true\">"
        "<rect width=\"10\" height=\"10\" rx=\"2\" fill=\"" +
        SwatchOf(i) + "\"/></svg>" + name + "</label></th><td class=\"number\">" +
        Grouped(layers[i].edges) + "</td><td class=\"number\">" +
        PercentOf(layers[i].line_measure_m, measure) + "</td></tr>");
  }
  return html + "</tbody></table>"_html;
}

Html Notes(const MapContents& map) {
  std::string notes = "Lit from the upper left";
  if (map.exaggeration != 1) {
    notes += "; heights drawn " + Shortest(map.exaggeration) + " times as large";
  }
  notes += ".";
  if (map.report.dem.nodata_posts > 0) notes += " White: no data.";
  if (map.frame.IsStretched()) notes += " The strip is drawn wider than it is.";
  return "<p class=\"note\">"_html + Html::Text(notes) + "</p>"_html;
}

}  // namespace

Result<Html> MapSection(const MapContents& map) {
  const std::array<EdgeLayer, kSectors + 1> layers = DrawEdgeLayers(map.features, map.frame);
  Result<Html> edges = EdgePictures(layers, map.frame);
  if (!edges) return edges;
  Html html =
      "<div class=\"controls\">"_html + Choice(map.reliefs.size()) +
      "<label class=\"compare\"><span>Compare with the DEM</span> <input type=\"range\" "
      "min=\"0\" max=\"100\" value=\"0\" data-compares=\"map\"></label>"
      "<label class=\"toggle\"><input type=\"checkbox\" data-enlarges=\"map\">Enlarge</label>"
      "</div><div class=\"atlas\"><div class=\"window\"><div class=\"map\" "
      "id=\"map\">"_html;
  for (std::size_t i = 0; i < map.reliefs.size(); ++i) {
    Result<Html> figure = Figure(map, i, i == 0 ? *edges : Html());
    if (!figure) return figure;
    html += *figure;
  }
  return html + "</div></div><div class=\"legend\">"_html + Legend(map, layers) + Notes(map) +
         "</div></div>"_html;
}

}  // namespace farhorizon
