// The skylines are drawn over one another to one scale, their difference below to its own, from
// zero: red where the mesh stands too high, blue where it is too low. The map has runs of equal
// colour as strokes of one path a colour, so that its size follows what is in it.
#include "core/io/compare_svg.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "core/io/geojson_text.h"
#include "core/io/svg_text.h"

namespace farhorizon {

namespace {

constexpr double kLeft = 80;  // room for labels, pixels
constexpr double kWidth = 1180;
constexpr double kSkyline = 120;  // heights of what is drawn
constexpr double kDifference = 56;
constexpr double kGap = 46;
constexpr double kMapSide = 560;
constexpr int kShades = 4;  // on either side of none

constexpr const char* kCompareStyle =
    "<style>\n"
    "text{font:13px sans-serif;fill:#222}\n"
    ".title{font:600 17px sans-serif}\n"
    ".label{fill:#666}\n"
    ".dem{fill:#dfe5d8;stroke:none}\n"
    ".demline{fill:none;stroke:#44563f;stroke-width:1.6}\n"
    ".mesh{fill:none;stroke:#c2410c;stroke-width:1.1}\n"
    ".zero{stroke:#999;stroke-width:.6}\n"
    ".above{fill:#c0392b}.below{fill:#2563a8}\n"
    ".frame{fill:#f4f4f2;stroke:#bbb;stroke-width:.6}\n"
    ".map{fill:none}\n"
    "</style>\n";

// From the mesh far below the DEM to far above it.
constexpr std::array<const char*, 2 * kShades + 1> kColours = {"#16437e", "#3b78b8", "#8db8dd",
                                                               "#cfe0ee", "#f0efe9", "#f4d3c4",
                                                               "#e69a7b", "#c95a40", "#8f1d1d"};

// Metres, or what suits small ones.
std::string LengthText(double metres) {
  const double size = std::abs(metres);
  if (size > 0 && size < 0.1) return Rounded(metres * 1000, size < 0.01 ? 2 : 0) + " mm";
  return Rounded(metres, size < 1 ? 3 : size < 100 ? 2 : 0) + " m";
}

std::string Text(double x, double y, const std::string& text, const char* more = "") {
  return "<text x=\"" + SvgNumber(x) + "\" y=\"" + SvgNumber(y) + "\"" + more + ">" +
         SvgText(text) + "</text>\n";
}

std::string XY(double x, double y) { return SvgNumber(x) + "," + SvgNumber(y); }

double X(std::size_t i, std::size_t count) {
  return kLeft + kWidth * static_cast<double>(i) / static_cast<double>(count - 1);
}

// The line through the values that are there; y: of a value.
template <typename ToY>
std::string PathOf(const std::vector<double>& values, ToY y) {
  std::string path;
  bool drawn = false;
  for (std::size_t i = 0; i < values.size(); ++i) {
    const bool there = std::isfinite(values[i]);
    if (there) path += (drawn ? "L" : "M") + XY(X(i, values.size()), y(values[i]));
    drawn = there;
  }
  return path;
}

// The area between the values and a floor.
template <typename ToY>
std::string AreaOf(const std::vector<double>& values, double floor, ToY y) {
  std::string path;
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (!std::isfinite(values[i])) continue;
    const bool first = i == 0 || !std::isfinite(values[i - 1]);
    const bool last = i + 1 == values.size() || !std::isfinite(values[i + 1]);
    const double x = X(i, values.size());
    if (first) path += "M" + XY(x, floor);
    path += "L" + XY(x, y(values[i]));
    if (last) path += "L" + XY(x, floor) + "Z";
  }
  return path;
}

std::string PathTag(const char* kind, const std::string& path) {
  return std::string("<path class=\"") + kind + "\" d=\"" + path + "\"/>\n";
}

std::string DrawPair(const SkylinePair& pair, double top) {
  double least = std::numeric_limits<double>::infinity();
  double most = -least;
  std::vector<double> above;
  std::vector<double> below;
  double greatest = 0;
  for (std::size_t i = 0; i < pair.dem_m.size(); ++i) {
    for (const double height : {pair.dem_m[i], pair.mesh_m[i]}) {
      if (!std::isfinite(height)) continue;
      least = std::min(least, height);
      most = std::max(most, height);
    }
    const double off = pair.mesh_m[i] - pair.dem_m[i];
    // What grazes the outline, where a skyline ends in a cliff, does not set the scale.
    const std::size_t rim = pair.dem_m.size() / 100;
    const bool within = i >= rim && i + rim < pair.dem_m.size();
    if (std::isfinite(off) && within) greatest = std::max(greatest, std::abs(off));
    above.push_back(std::isfinite(off) ? std::max(off, 0.0) : off);
    below.push_back(std::isfinite(off) ? std::min(off, 0.0) : off);
  }
  if (!(most >= least)) return Text(kLeft, top + 20, "nothing is seen in this direction");
  const double range = std::max(most - least, 0.01);
  const double bottom = top + kSkyline;
  const auto y = [&](double height) { return bottom - (height - least) / range * kSkyline; };
  const double zero = bottom + 8 + kDifference / 2;
  const double scale = greatest > 0 ? kDifference / 2 / greatest : 0;
  const auto difference = [&](double off) {
    return zero - std::clamp(off, -greatest, greatest) * scale;
  };
  const double width = pair.offsets_m.back() - pair.offsets_m.front();
  std::string text = PathTag("dem", AreaOf(pair.dem_m, bottom, y));
  text += PathTag("demline", PathOf(pair.dem_m, y));
  text += PathTag("mesh", PathOf(pair.mesh_m, y));
  text += PathTag("zero", "M" + XY(kLeft, zero) + "h" + SvgNumber(kWidth));
  text += PathTag("above", AreaOf(above, zero, difference));
  text += PathTag("below", AreaOf(below, zero, difference));
  constexpr const char* kEnd = " text-anchor=\"end\" class=\"label\"";
  text += Text(kLeft - 8, top + 5, LengthText(most), kEnd);
  text += Text(kLeft - 8, bottom, LengthText(least), kEnd);
  text += Text(kLeft - 8, zero - kDifference / 2 + 8, "+" + LengthText(greatest), kEnd);
  text += Text(kLeft - 8, zero + kDifference / 2 + 4, "-" + LengthText(greatest), kEnd);
  std::string told = "towards " + Rounded(pair.azimuth_deg, 1) + " degrees, " + Rounded(width, 0) +
                     " m wide, heights drawn " + Rounded(kSkyline / range / (kWidth / width), 1) +
                     " times as large";
  if (scale > 0) {
    told += "; the difference enlarged " + Rounded(scale * range / kSkyline, 1) + " times more";
  }
  return text + Text(kLeft, top - 8, told);
}

// The error that the darkest colour stands for: 98 of 100 are smaller.
double ScaleOf(const ErrorMap& map) {
  std::vector<double> sizes;
  for (const double e : map.errors_m) {
    if (std::isfinite(e)) sizes.push_back(std::abs(e));
  }
  if (sizes.empty()) return 0;
  const auto at = sizes.begin() + static_cast<std::ptrdiff_t>(sizes.size() * 98 / 100);
  std::nth_element(sizes.begin(), at, sizes.end());
  return *at;
}

// A colour's number; as many as there are colours where there is nothing.
std::size_t ColourOf(double error, double scale) {
  if (!std::isfinite(error)) return kColours.size();
  const double shade = scale > 0 ? error / scale * (kShades + 0.5) : 0;
  const double clamped = std::clamp(std::round(shade), -double{kShades}, double{kShades});
  return static_cast<std::size_t>(clamped + kShades);
}

std::string DrawMap(const ErrorMap& map, double top) {
  const double scale = ScaleOf(map);
  const double cell = std::min(kMapSide / map.rows, kWidth * 0.75 / (map.columns * map.aspect));
  const double width = cell * map.aspect;
  std::array<std::string, kColours.size()> paths;
  for (std::int32_t r = 0; r < map.rows; ++r) {
    const auto colour = [&](std::int32_t c) {
      return ColourOf(
          map.errors_m[static_cast<std::size_t>(r) * static_cast<std::size_t>(map.columns) +
                       static_cast<std::size_t>(c)],
          scale);
    };
    for (std::int32_t from = 0; from < map.columns;) {
      std::int32_t to = from + 1;
      while (to < map.columns && colour(to) == colour(from)) ++to;
      if (colour(from) < kColours.size()) {
        paths[colour(from)] += "M" + XY(kLeft + from * width, top + (r + 0.5) * cell) + "H" +
                               SvgNumber(kLeft + to * width);
      }
      from = to;
    }
  }
  std::string text = "<rect class=\"frame\" x=\"" + SvgNumber(kLeft) + "\" y=\"" + SvgNumber(top) +
                     "\" width=\"" + SvgNumber(map.columns * width) + "\" height=\"" +
                     SvgNumber(map.rows * cell) + "\"/>\n";
  for (std::size_t i = 0; i < kColours.size(); ++i) {
    if (paths[i].empty()) continue;
    // A tenth more than a cell, so that no seam shows between rows.
    text += std::string("<path class=\"map\" stroke=\"") + kColours[i] + "\" stroke-width=\"" +
            SvgNumber(cell + 0.1) + "\" d=\"" + paths[i] + "\"/>\n";
  }
  const double x = kLeft + map.columns * width + 24;
  for (std::size_t i = 0; i < kColours.size(); ++i) {
    const double y = top + 20 * static_cast<double>(kColours.size() - 1 - i);
    text += "<rect x=\"" + SvgNumber(x) + "\" y=\"" + SvgNumber(y) +
            "\" width=\"22\" height=\"20\" fill=\"" + kColours[i] + "\"/>\n";
    const double middle = scale * (static_cast<double>(i) - kShades) / (kShades + 0.5);
    text += Text(x + 30, y + 14, (middle > 0 ? "+" : "") + LengthText(middle));
  }
  text += Text(x, top + 20 * static_cast<double>(kColours.size()) + 20, "mesh less DEM", "");
  return text + Text(kLeft, top - 8, "vertical error; grey: nothing to compare");
}

}  // namespace

std::string DrawComparisonSvg(const ComparisonPicture& picture) {
  double y = 34;
  std::string body = Text(kLeft, y, picture.title, " class=\"title\"");
  for (const std::string& line : picture.lines) body += Text(kLeft, y += 20, line);
  y += 20;
  body += "<text x=\"" + SvgNumber(kLeft) + "\" y=\"" + SvgNumber(y) +
          "\">skylines: DEM <tspan fill=\"#44563f\">green</tspan>, mesh <tspan "
          "fill=\"#c2410c\">orange</tspan>; below, enlarged, mesh less DEM</text>\n";
  y += 34;
  for (const SkylinePair& pair : picture.skylines) {
    body += DrawPair(pair, y);
    y += kSkyline + 8 + kDifference + kGap;
  }
  const ErrorMap& map = picture.map;
  if (map.columns > 0 && map.rows > 0) {
    body += DrawMap(map, y);
    y += std::max(kMapSide, 240.0);
  }
  return "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"" + SvgNumber(kLeft + kWidth + 30) +
         "\" height=\"" + SvgNumber(y + 30) + "\">\n<title>" + SvgText(picture.title) +
         "</title>\n" + kCompareStyle + "<rect width=\"100%\" height=\"100%\" fill=\"white\"/>\n" +
         body + "</svg>\n";
}

}  // namespace farhorizon
