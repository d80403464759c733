// Draws a trace of the sweep as layers of SVG paths, each in a group with a class that the style
// sheet and the legend name. Grid coordinates are scaled so that the longer side has kPicture
// pixels.
#include "core/io/sweep_svg.h"

#include <algorithm>
#include <array>

#include "core/io/svg_text.h"

namespace farhorizon {

namespace {

constexpr double kPicture = 1000;  // pixels, the longer side
constexpr double kMargin = 12;
constexpr double kLegend = 290;
constexpr double kLegendLine = 24;

class Drawing {
 public:
  explicit Drawing(const SweepTrace& trace)
      : columns_(trace.columns),
        rows_(trace.rows),
        scale_(kPicture / std::max({trace.columns - 1, trace.rows - 1, 1})) {}

  [[nodiscard]] double width() const { return (columns_ - 1) * scale_ + 2 * kMargin + kLegend; }
  [[nodiscard]] double height() const {
    return std::max((rows_ - 1) * scale_ + 2 * kMargin, kMargin + 10 * kLegendLine);
  }
  [[nodiscard]] double legend_x() const { return (columns_ - 1) * scale_ + 3 * kMargin; }

  [[nodiscard]] std::string At(PlanPoint p) const {
    return SvgNumber(kMargin + p.x * scale_) + "," + SvgNumber(kMargin + p.y * scale_);
  }
  template <typename Points>
  [[nodiscard]] std::string Path(const Points& points, bool closed) const {
    std::string path;
    for (const PlanPoint& p : points) path += (path.empty() ? 'M' : 'L') + At(p);
    return path + (closed ? "Z" : "");
  }
  [[nodiscard]] std::string Terrain() const {
    return "<rect class=\"terrain\" x=\"" + SvgNumber(kMargin) + "\" y=\"" + SvgNumber(kMargin) +
           "\" width=\"" + SvgNumber((columns_ - 1) * scale_) + "\" height=\"" +
           SvgNumber((rows_ - 1) * scale_) + "\"/>\n";
  }
  [[nodiscard]] std::string Dot(PlanPoint p) const {
    return "<circle cx=\"" + SvgNumber(kMargin + p.x * scale_) + "\" cy=\"" +
           SvgNumber(kMargin + p.y * scale_) + "\" r=\"2.5\"/>\n";
  }

 private:
  std::int32_t columns_;
  std::int32_t rows_;
  double scale_;
};

constexpr const char* kSweepStyle =
    "<style>\n"
    "text{font:14px sans-serif;fill:#222}\n"
    ".terrain{fill:#f7f5f0;stroke:#999}\n"
    ".contours{fill:none;stroke:#7a5c3a;stroke-width:1}\n"
    ".hulls{fill:#4a90d9;fill-opacity:.18;stroke:#2a66a8;stroke-width:1.6;"
    "stroke-linecap:round;stroke-linejoin:round}\n"
    ".inactive{fill:none;stroke:#888;stroke-width:.6;stroke-opacity:.45}\n"
    ".active{fill:none;stroke:#1a9850;stroke-width:1}\n"
    ".candidates{fill:none;stroke:#f08c00;stroke-width:2.2;stroke-linecap:round}\n"
    ".seen{fill:#d7191c;stroke:none}\n"
    "</style>\n";

std::string Group(const char* name, const std::string& content) {
  return std::string("<g class=\"") + name + "\">\n" + content + "</g>\n";
}

std::string Paths(const std::vector<std::string>& shapes) {
  std::string text;
  for (const std::string& shape : shapes) text += "<path d=\"" + shape + "\"/>\n";
  return text;
}

struct LegendLine {
  const char* name;  // its class
  std::string text;
};

std::string Legend(const Drawing& drawing, const std::string& title,
                   const std::vector<LegendLine>& lines) {
  const double x = drawing.legend_x();
  double y = kMargin + kLegendLine;
  const auto write = [&](double at, const std::string& text) {
    return "<text x=\"" + SvgNumber(at) + "\" y=\"" + SvgNumber(y) + "\">" + SvgText(text) +
           "</text>\n";
  };
  std::string legend = write(x, title);
  for (const LegendLine& line : lines) {
    y += kLegendLine;
    const std::string sample = "M" + SvgNumber(x) + "," + SvgNumber(y - 10) + "h26v10h-26z";
    legend += Group(line.name, "<path d=\"" + sample + "\"/>\n") + write(x + 36, line.text);
  }
  return Group("legend", legend);
}

}  // namespace

std::string DrawSweep(const SweepTrace& trace, const std::string& title) {
  const Drawing drawing(trace);
  std::vector<std::string> contours;
  contours.reserve(trace.contours.size());
  for (const auto& contour : trace.contours) contours.push_back(drawing.Path(contour, false));
  std::vector<std::string> hulls;
  hulls.reserve(trace.hulls.size());
  for (const auto& hull : trace.hulls) hulls.push_back(drawing.Path(hull, true));
  std::array<std::string, 2> bitangents;  // inactive, active: one path each, they are many
  std::array<std::size_t, 2> counts{};
  for (const SweepTrace::Bitangent& b : trace.bitangents) {
    bitangents[b.active ? 1 : 0] += drawing.Path(b.contacts, false);
    ++counts[b.active ? 1 : 0];
  }
  std::string candidates;
  for (const auto& candidate : trace.candidates) candidates += drawing.Path(candidate, false);
  std::string seen;
  for (const PlanPoint& p : trace.horizon_points) seen += drawing.Dot(p);

  const auto count = [](const char* what, std::size_t n) {
    return what + (": " + std::to_string(n));
  };
  return "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"" + SvgNumber(drawing.width()) +
         "\" height=\"" + SvgNumber(drawing.height()) + "\">\n<title>" + SvgText(title) +
         "</title>\n" + kSweepStyle + "<rect width=\"100%\" height=\"100%\" fill=\"white\"/>\n" +
         drawing.Terrain() + Group("contours", Paths(contours)) + Group("hulls", Paths(hulls)) +
         Group("inactive", Paths({bitangents[0]})) + Group("active", Paths({bitangents[1]})) +
         Group("candidates", Paths({candidates})) + Group("seen", seen) +
         Legend(drawing, title,
                {{"contours", count("contours", contours.size())},
                 {"hulls", count("merged hulls", hulls.size())},
                 {"active", count("active bitangents", counts[1])},
                 {"inactive", count("inactive bitangents", counts[0])},
                 {"candidates", count("candidate edges at this level", trace.candidates.size())},
                 {"seen", count("seen on the horizon so far", trace.horizon_points.size())}}) +
         "</svg>\n";
}

}  // namespace farhorizon
