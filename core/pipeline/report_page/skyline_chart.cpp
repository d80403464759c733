// Paths count y in tenths of a pixel, and x in pixels from the plot's left side: whole numbers keep
// the page small. Differences are drawn in their level's own scale; where all levels are shown,
// each is scaled down to the common one.
//
//   +--------------------+
//   |    __/\_           | kTop      heights
//   |___/     \____/\____| kBottom
//   | ---~--------^----- | kZero     differences, kHalf to either side
//   +--------------------+ kAxis     offsets
#include "core/pipeline/report_page/skyline_chart.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "core/io/geojson_text.h"
#include "core/io/svg_text.h"
#include "core/io/ticks.h"
#include "core/pipeline/report_page/figures.h"

namespace farhorizon {

namespace {

constexpr int kColumns = 388;
constexpr int kLinesAColumn = kLinesAcross / kColumns;
constexpr double kHeight = 268;
constexpr double kLeft = 46;
constexpr double kTop = 12;
constexpr double kBottom = 122;
constexpr double kZero = 186;
constexpr double kHalf = 38;
constexpr double kAxis = kZero + kHalf + 2;

// The part of the lines that a column of the chart shows: of each, the one where the level is off
// most.
struct Column {
  double terrain_m = std::numeric_limits<double>::quiet_NaN();
  double difference_m = std::numeric_limits<double>::quiet_NaN();
};

std::vector<Column> ColumnsOf(const SkylineProfile& terrain, const SkylineProfile& level) {
  std::vector<Column> columns(kColumns);
  for (std::size_t i = 0; i < terrain.size(); ++i) {
    Column& column = columns[i / kLinesAColumn];
    const double difference = level[i] - terrain[i];
    if (std::isnan(difference)) continue;
    if (std::isnan(column.difference_m) || std::abs(difference) > std::abs(column.difference_m)) {
      column = {terrain[i], difference};
    }
  }
  return columns;
}

// The largest of 1, 2 and 5 times a power of ten that is not above `value`.
double RoundFactor(double value) {
  const double power = std::pow(10.0, std::floor(std::log10(value)));
  for (const double digit : {5.0, 2.0}) {
    if (digit * power <= value) return digit * power;
  }
  return power;
}

std::string Tenths(double pixels) { return std::to_string(std::lround(10 * pixels)); }

// A path through y by column, tenths of a pixel; interrupted where there is none.
class PathText {
 public:
  void Add(double y_pixels) {
    if (!std::isnan(y_pixels)) {
      const auto y = std::lround(10 * y_pixels);
      if (drawing_) {
        text_ += " 1 " + std::to_string(y - last_);
      } else {
        text_ += "M" + std::to_string(column_) + " " + std::to_string(y) + "l";
      }
      last_ = y;
    }
    drawing_ = !std::isnan(y_pixels);
    ++column_;
  }
  [[nodiscard]] const std::string& text() const { return text_; }

 private:
  std::string text_;
  bool drawing_ = false;
  int column_ = 0;
  decltype(std::lround(0.0)) last_ = 0;
};

std::string Text(double x, double y, const std::string& anchor, const std::string& text) {
  return "<text x=\"" + SvgNumber(x) + "\" y=\"" + SvgNumber(y) + "\" text-anchor=\"" + anchor +
         "\">" + text + "</text>";
}

class Chart {
 public:
  Chart(const SkylineSet& set, const SkylineScale& scale) : set_(set), scale_(scale) {}

  [[nodiscard]] std::string Drawing() const {
    std::string drawing =
        "<g id=\"" + Id() + "\"><g transform=\"translate(46 0) scale(1 .1)\">" + TerrainPath();
    for (std::size_t level = 0; level < set_.levels.size(); ++level) {
      const std::vector<Column> columns = ColumnsOf(set_.terrain, set_.levels[level]);
      drawing += "<path " + Marks("line", level) + " d=\"" + LevelPath(columns) + "\"/>";
    }
    drawing += "</g><g transform=\"translate(46 " + SvgNumber(kZero) + ") scale(1 .1)\">";
    for (std::size_t level = 0; level < set_.levels.size(); ++level) {
      const std::vector<Column> columns = ColumnsOf(set_.terrain, set_.levels[level]);
      const std::string common =
          "scale(1 " + Exact(scale_.common_factor / scale_.level_factors[level]) + ")";
      drawing += "<path " + Marks("difference", level) + " transform=\"" + common +
                 "\" data-common=\"" + common + "\" d=\"" + DifferencePath(columns, level) + "\"/>";
    }
    return drawing + "</g></g>";
  }

  [[nodiscard]] std::string Opening(int azimuth_deg) const {
    return "<svg class=\"chart\" viewBox=\"0 -6 440 274\" role=\"img\" aria-label=\"Skylines, "
           "looking " +
           PointOfCompass(azimuth_deg) + "; the table below has the differences\">" + Axes();
  }

  [[nodiscard]] std::string Id() const {
    return "sky-" + std::to_string(std::lround(set_.lines.azimuth_deg));
  }

 private:
  static std::string Marks(const std::string& what, std::size_t level) {
    const std::string number = std::to_string(level);
    return "class=\"" + what + " lod" + number + "\" data-level=\"" + number + "\"";
  }
  [[nodiscard]] double Y(double height_m) const {
    return kBottom - (height_m - scale_.least_m) * scale_.pixels_a_metre;
  }

  // One closed shape for each run of columns over ground.
  [[nodiscard]] std::string TerrainPath() const {
    std::string area;
    PathText line;
    std::string floor = Tenths(kBottom);
    bool open = false;
    for (int i = 0; i < kColumns; ++i) {
      const double y =
          Y(set_.terrain[static_cast<std::size_t>(i * kLinesAColumn + kLinesAColumn / 2)]);
      line.Add(y);
      if (std::isnan(y) && open) area += "V" + floor + "Z";
      if (!std::isnan(y)) {
        if (!open) area += "M" + std::to_string(i) + " " + floor;
        area += "L" + std::to_string(i) + " " + Tenths(y);
      }
      open = !std::isnan(y);
    }
    if (open) area += "V" + floor + "Z";
    return "<path class=\"ground\" id=\"" + Id() + "-ground\" d=\"" + area +
           "\"/><path class=\"terrain\" d=\"" + line.text() + "\"/>";
  }

  [[nodiscard]] std::string LevelPath(const std::vector<Column>& columns) const {
    PathText path;
    for (const Column& c : columns) path.Add(Y(c.terrain_m + c.difference_m));
    return path.text();
  }

  [[nodiscard]] std::string DifferencePath(const std::vector<Column>& columns,
                                           std::size_t level) const {
    PathText path;
    const double scale = scale_.pixels_a_metre * scale_.level_factors[level];
    for (const Column& c : columns) path.Add(-c.difference_m * scale);
    return path.text();
  }

  [[nodiscard]] std::string Axes() const {
    std::string text;
    const double highest_m = scale_.least_m + (kBottom - kTop) / scale_.pixels_a_metre;
    for (const double at :
         TicksWithin(scale_.least_m, highest_m, TickStep(highest_m - scale_.least_m, 4))) {
      const std::string y = SvgNumber(Y(at));
      text += "<path class=\"grid\" d=\"M46 " + y + "h388\"/>" +
              Text(kLeft - 5, Y(at) + 4, "end", Rounded(at, 3));
    }
    const double half_m = set_.lines.spacing * set_.lines.count / 2;
    const bool in_km = half_m >= 2000;
    for (const double at : TicksWithin(-half_m, half_m, TickStep(2 * half_m, 5))) {
      const double x = kLeft + (at + half_m) / (2 * half_m) * kColumns;
      text += "<path class=\"tick\" d=\"M" + SvgNumber(x) + " " + SvgNumber(kAxis) + "v4\"/>" +
              Text(x, kAxis + 16, "middle", Rounded(in_km ? at / 1000 : at, 3));
    }
    text += Text(kLeft + kColumns, kHeight - 4, "end",
                 std::string(in_km ? "km" : "m") + " to the left and right");
    text += Text(2, kTop - 8, "start", "m") + "<path class=\"zero\" d=\"M46 " + SvgNumber(kZero) +
            "h388\"/>" + Factors();
    return text;
  }

  [[nodiscard]] std::string Factors() const {
    const auto factor = [this](const std::string& level, double times) {
      const double half_m = kHalf / scale_.pixels_a_metre / times;
      return "<text class=\"factor\" data-level=\"" + level + "\" x=\"46\" y=\"" +
             SvgNumber(kZero - kHalf - 6) + "\">difference, enlarged " + Shortest(times) +
             " times: \u00b1" + ThreeDigits(half_m) + " m</text>";
    };
    std::string text = factor("all", scale_.common_factor);
    for (std::size_t level = 0; level < scale_.level_factors.size(); ++level) {
      text += factor(std::to_string(level), scale_.level_factors[level]);
    }
    return text;
  }

  const SkylineSet& set_;
  const SkylineScale& scale_;
};

}  // namespace

SkylineDifference DifferenceOf(const SkylineProfile& terrain, const SkylineProfile& level) {
  SkylineDifference difference;
  double squares = 0;
  int count = 0;
  for (std::size_t i = 0; i < terrain.size(); ++i) {
    const double d = level[i] - terrain[i];
    if (std::isnan(d)) continue;
    difference.greatest_m = std::max(difference.greatest_m, std::abs(d));
    squares += d * d;
    ++count;
  }
  if (count > 0) difference.rms_m = std::sqrt(squares / count);
  return difference;
}

SkylineScale ScaleOf(const std::vector<SkylineSet>& sets) {
  double least = std::numeric_limits<double>::infinity();
  double most = -least;
  std::vector<double> greatest(sets.front().levels.size());
  for (const SkylineSet& set : sets) {
    for (const double height : set.terrain) {
      if (std::isnan(height)) continue;
      least = std::min(least, height);
      most = std::max(most, height);
    }
    for (std::size_t level = 0; level < greatest.size(); ++level) {
      greatest[level] =
          std::max(greatest[level], DifferenceOf(set.terrain, set.levels[level]).greatest_m);
    }
  }
  SkylineScale scale;
  if (least > most) least = most = 0;  // no line meets anything
  // A tenth of the range below the lowest, and at least a centimetre, as level ground has none.
  const double range = std::max(1.1 * (most - least), 0.01);
  scale.least_m = most - range;
  scale.pixels_a_metre = (kBottom - kTop) / range;
  const auto factor = [&scale](double difference_m) {
    // Differences of less than a micrometre are those of doubles: drawn as none.
    return RoundFactor(kHalf / scale.pixels_a_metre / std::max(difference_m, 1e-6));
  };
  for (const double difference : greatest) scale.level_factors.push_back(factor(difference));
  scale.common_factor = *std::min_element(scale.level_factors.begin(), scale.level_factors.end());
  return scale;
}

Html SkylineChart(const SkylineSet& set, const SkylineScale& scale) {
  const Chart chart(set, scale);
  return Html::Markup(chart.Opening(static_cast<int>(std::lround(set.lines.azimuth_deg))) +
                      chart.Drawing() + "</svg>");
}

Html MirroredSkylineChart(const SkylineSet& set, const SkylineScale& scale) {
  const Chart chart(set, scale);
  const int azimuth = static_cast<int>(std::lround(set.lines.azimuth_deg)) + 180;
  return Html::Markup(chart.Opening(azimuth % 360) + "<use href=\"#" + chart.Id() +
                      "\" transform=\"translate(480 0) scale(-1 1)\"/></svg>");
}

Html SkylineBanner(const SkylineSet& set) {
  return Html::Markup(
      "<svg class=\"banner\" viewBox=\"0 120 387 1100\" preserveAspectRatio=\"none\" "
      "aria-hidden=\"true\"><use href=\"#sky-" +
      std::to_string(std::lround(set.lines.azimuth_deg)) + "-ground\"/></svg>");
}

}  // namespace farhorizon
