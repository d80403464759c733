// Errors against triangles, both on logarithmic axes, where a level with half the error at twice
// the triangles is as far away at any size. SVG that is put together by hand: the page has no
// script for it.
#include "core/pipeline/report_page/error_chart.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <string>

#include "core/io/geojson_text.h"
#include "core/io/svg_text.h"
#include "core/pipeline/report_page/figures.h"

namespace farhorizon {

namespace {

constexpr double kLeft = 54;
constexpr double kRight = 420;
constexpr double kTop = 14;
constexpr double kBottom = 262;

// A logarithmic axis from a power of ten to another.
class LogAxis {
 public:
  // values: what it has to reach; those that are not positive are left out.
  LogAxis(const std::vector<double>& values, double from_pixels, double to_pixels)
      : from_pixels_(from_pixels), to_pixels_(to_pixels) {
    double least = std::numeric_limits<double>::infinity();
    double most = 0;
    for (const double value : values) {
      if (!(value > 0)) continue;
      least = std::min(least, value);
      most = std::max(most, value);
    }
    if (most == 0) least = most = 1;
    least_ = static_cast<int>(std::floor(std::log10(least)));
    most_ = std::max(static_cast<int>(std::ceil(std::log10(most))), least_ + 1);
  }

  [[nodiscard]] double Place(double value) const {
    if (!(value > 0)) return from_pixels_;
    const double share = (std::log10(value) - least_) / (most_ - least_);
    return from_pixels_ + share * (to_pixels_ - from_pixels_);
  }
  // Powers of ten; where there are few, also twice and five times those.
  [[nodiscard]] std::vector<double> Ticks() const {
    std::vector<double> ticks;
    for (int power = least_; power <= most_; ++power) {
      for (const double digit : {1.0, 2.0, 5.0}) {
        const bool within = power < most_ || digit == 1;
        if (within && (digit == 1 || most_ - least_ <= 2)) {
          ticks.push_back(digit * std::pow(10.0, power));
        }
      }
    }
    return ticks;
  }

 private:
  int least_ = 0;
  int most_ = 1;
  double from_pixels_;
  double to_pixels_;
};

struct Series {
  const char* classes;
  double (*value)(const LevelReport&);
};
constexpr std::array<Series, 4> kSeries = {{
    {"vertical greatest", [](const LevelReport& l) { return l.vertical.max_m; }},
    {"vertical", [](const LevelReport& l) { return l.vertical.rms_m; }},
    {"silhouette greatest", [](const LevelReport& l) { return l.silhouette.max_m; }},
    {"silhouette", [](const LevelReport& l) { return l.silhouette.rms_m; }},
}};

std::string Text(double x, double y, const std::string& anchor, const std::string& text) {
  return "<text x=\"" + SvgNumber(x) + "\" y=\"" + SvgNumber(y) + "\" text-anchor=\"" + anchor +
         "\">" + text + "</text>";
}

// "50k" for 50000: room for labels is short.
std::string ShortCount(double value) {
  if (value >= 1e6) return Rounded(value / 1e6, 3) + "M";
  return value >= 1e3 ? Rounded(value / 1e3, 3) + "k" : Rounded(value, 0);
}

std::string Axes(const LogAxis& triangles, const LogAxis& errors) {
  std::string text;
  for (const double at : errors.Ticks()) {
    const double y = errors.Place(at);
    text += "<path class=\"grid\" d=\"M" + SvgNumber(kLeft) + " " + SvgNumber(y) + "H" +
            SvgNumber(kRight) + "\"/>" + Text(kLeft - 6, y + 4, "end", Rounded(at, 9));
  }
  for (const double at : triangles.Ticks()) {
    const double x = triangles.Place(at);
    text += "<path class=\"grid\" d=\"M" + SvgNumber(x) + " " + SvgNumber(kTop) + "V" +
            SvgNumber(kBottom) + "\"/>" + Text(x, kBottom + 18, "middle", ShortCount(at));
  }
  return text + Text(2, kTop - 3, "start", "m") + Text(kRight, kBottom + 34, "end", "triangles");
}

std::string Point(const Series& series, const LevelReport& level, double x, double y) {
  const std::string classes = "point " + std::string(series.classes);
  const std::string title = "<title>level " + std::to_string(level.level) + ": " +
                            ThreeDigits(series.value(level)) + " m at " + Grouped(level.triangles) +
                            " triangles</title>";
  if (classes.find("greatest") != std::string::npos) {
    return "<rect class=\"" + classes + "\" x=\"" + SvgNumber(x - 3.5) + "\" y=\"" +
           SvgNumber(y - 3.5) + "\" width=\"7\" height=\"7\">" + title + "</rect>";
  }
  return "<circle class=\"" + classes + "\" cx=\"" + SvgNumber(x) + "\" cy=\"" + SvgNumber(y) +
         "\" r=\"4\">" + title + "</circle>";
}

}  // namespace

Html ErrorChart(const std::vector<LevelReport>& levels) {
  std::vector<double> counts;
  std::vector<double> errors;
  for (const LevelReport& level : levels) {
    counts.push_back(static_cast<double>(level.triangles));
    for (const Series& series : kSeries) errors.push_back(series.value(level));
  }
  const LogAxis x_axis(counts, kLeft, kRight);
  const LogAxis y_axis(errors, kBottom, kTop);
  std::string chart =
      "<svg class=\"chart\" viewBox=\"0 0 440 300\" role=\"img\" aria-label=\"Errors against "
      "triangles, both logarithmic; the table below has the numbers\">" +
      Axes(x_axis, y_axis);
  for (const Series& series : kSeries) {
    std::string path;
    std::string points;
    for (const LevelReport& level : levels) {
      const double x = x_axis.Place(static_cast<double>(level.triangles));
      const double y = y_axis.Place(series.value(level));
      path += (path.empty() ? "M" : "L") + SvgNumber(x) + " " + SvgNumber(y);
      points += Point(series, level, x, y);
    }
    chart +=
        "<path class=\"series " + std::string(series.classes) + "\" d=\"" + path + "\"/>" + points;
  }
  for (const LevelReport& level : levels) {
    chart += "<text class=\"name\" text-anchor=\"middle\" x=\"" +
             SvgNumber(x_axis.Place(static_cast<double>(level.triangles))) + "\" y=\"" +
             SvgNumber(y_axis.Place(level.silhouette.rms_m) - 8) + "\">" +
             std::to_string(level.level) + "</text>";
  }
  return Html::Markup(chart + "</svg>");
}

}  // namespace farhorizon
