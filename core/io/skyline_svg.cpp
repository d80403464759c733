// Draws the skyline of one direction: offsets from left to right, heights upwards, depth as shade.
// One path for the ground below parts that touch, one path for the parts of each shade, axes with
// round ticks. Everything is scaled to a plot of fixed size.
#include "core/io/skyline_svg.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

#include "core/io/geojson_text.h"
#include "core/io/svg_text.h"
#include "core/io/ticks.h"

namespace farhorizon {

namespace {

constexpr double kWidth = 1200;  // of the plot, in pixels
constexpr double kHeight = 300;
constexpr double kLeft = 70;  // room for labels
constexpr double kTop = 40;
constexpr double kBottom = 50;
constexpr double kRight = 30;
constexpr std::size_t kShades = 5;  // of depth

struct Range {
  double least = std::numeric_limits<double>::infinity();
  double most = -std::numeric_limits<double>::infinity();

  void Include(double value) {
    least = std::min(least, value);
    most = std::max(most, value);
  }
  // At least a centimetre: horizontal ground has a scale, too.
  [[nodiscard]] double Size() const { return std::max(most - least, 0.01); }
};

// About eight; none where nothing was included.
std::vector<double> TicksIn(const Range& range) {
  return TicksWithin(range.least, range.most, TickStep(range.Size(), 8));
}

class Plot {
 public:
  explicit Plot(const SkylineOfDirection& skyline) {
    for (const SkylineFeature& part : skyline.parts) {
      for (const std::size_t end : {0U, 1U}) {
        offsets_.Include(part.offset_m[end]);
        depths_.Include(part.depth_m[end]);
      }
      heights_.Include(part.left.height_m);
      heights_.Include(part.right.height_m);
    }
  }

  // The factor by which heights are drawn larger than distances.
  [[nodiscard]] double Exaggeration() const {
    return kHeight / heights_.Size() / (kWidth / offsets_.Size());
  }

  // The ground below the parts: one closed shape for each run of parts that touch. Ends that differ
  // by rounding alone touch; any tolerance far below a pixel is sound.
  [[nodiscard]] std::string Ground(const std::vector<SkylineFeature>& parts) const {
    const double touching = offsets_.Size() * 1e-9;
    const std::string floor = SvgNumber(kTop + kHeight);
    std::string path;
    for (std::size_t i = 0; i < parts.size(); ++i) {
      if (i == 0 || parts[i].offset_m[0] > parts[i - 1].offset_m[1] + touching) {
        path += "M" + SvgNumber(X(parts[i].offset_m[0])) + "," + floor;
      }
      path += "L" + Left(parts[i]) + "L" + Right(parts[i]);
      if (i + 1 == parts.size() || parts[i + 1].offset_m[0] > parts[i].offset_m[1] + touching) {
        path += "V" + floor + "Z";
      }
    }
    return "<path class=\"ground\" d=\"" + path + "\"/>\n";
  }

  // The parts as lines, one path for each shade of depth, the farthest first.
  [[nodiscard]] std::string Parts(const std::vector<SkylineFeature>& parts) const {
    std::array<std::string, kShades> paths;
    for (const SkylineFeature& part : parts) {
      const double depth = (part.depth_m[0] + part.depth_m[1]) / 2;
      const double share = (depth - depths_.least) / depths_.Size();
      const auto shade = static_cast<std::size_t>(share * kShades);
      paths[std::min(shade, kShades - 1)] += "M" + Left(part) + "L" + Right(part);
    }
    std::string text;
    for (std::size_t i = kShades; i-- > 0;) {
      text += "<path class=\"part depth" + std::to_string(i) + "\" d=\"" + paths[i] + "\"/>\n";
    }
    return text;
  }

  [[nodiscard]] std::string Axes() const {
    std::string text;
    for (const double at : TicksIn(offsets_)) {
      const std::string x = SvgNumber(X(at));
      text += "<path class=\"tick\" d=\"M" + x + "," + SvgNumber(kTop + kHeight) + "v6\"/>";
      text += "<text text-anchor=\"middle\" x=\"" + x + "\" y=\"" + SvgNumber(kTop + kHeight + 22) +
              "\">" + Rounded(at, 3) + "</text>\n";
    }
    for (const double at : TicksIn(heights_)) {
      const std::string y = SvgNumber(Y(at));
      text += "<path class=\"tick\" d=\"M" + SvgNumber(kLeft - 6) + "," + y + "h6\"/>";
      text += "<text text-anchor=\"end\" x=\"" + SvgNumber(kLeft - 10) + "\" y=\"" +
              SvgNumber(Y(at) + 5) + "\">" + Rounded(at, 3) + "</text>\n";
    }
    return text;
  }

 private:
  [[nodiscard]] double X(double offset) const {
    return kLeft + (offset - offsets_.least) / offsets_.Size() * kWidth;
  }
  [[nodiscard]] double Y(double height) const {
    return kTop + kHeight - (height - heights_.least) / heights_.Size() * kHeight;
  }
  [[nodiscard]] std::string Left(const SkylineFeature& part) const {
    return SvgNumber(X(part.offset_m[0])) + "," + SvgNumber(Y(part.left.height_m));
  }
  [[nodiscard]] std::string Right(const SkylineFeature& part) const {
    return SvgNumber(X(part.offset_m[1])) + "," + SvgNumber(Y(part.right.height_m));
  }

  Range offsets_;
  Range depths_;
  Range heights_;
};

constexpr const char* kSkylineStyle =
    "<style>\n"
    "text{font:13px sans-serif;fill:#222}\n"
    ".tick{stroke:#666}\n"
    ".ground{fill:#d8dfd0;stroke:none}\n"
    ".part{fill:none;stroke-width:1.8;stroke-linecap:round}\n"
    ".depth0{stroke:#1b2a1f}.depth1{stroke:#3b5548}.depth2{stroke:#5f8377}\n"
    ".depth3{stroke:#86aaab}.depth4{stroke:#aecad6}\n"
    "</style>\n";

std::string Line(double x, double y, const std::string& text) {
  return "<text x=\"" + SvgNumber(x) + "\" y=\"" + SvgNumber(y) + "\">" + SvgText(text) +
         "</text>\n";
}

}  // namespace

std::string DrawSkyline(const SkylineOfDirection& skyline, const std::string& title) {
  const Plot plot(skyline);
  const double bottom = kTop + kHeight + kBottom;
  const std::string told = title + ": " + std::to_string(skyline.parts.size()) +
                           (skyline.parts.size() == 1 ? " part" : " parts") +
                           " of horizon edges, the lighter the farther; heights drawn " +
                           Rounded(plot.Exaggeration(), 1) + " times as large";
  return "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"" + SvgNumber(kLeft + kWidth + kRight) +
         "\" height=\"" + SvgNumber(bottom) + "\">\n<title>" + SvgText(title) + "</title>\n" +
         kSkylineStyle + "<rect width=\"100%\" height=\"100%\" fill=\"white\"/>\n" +
         plot.Ground(skyline.parts) + plot.Parts(skyline.parts) + plot.Axes() +
         Line(kLeft, kTop - 16, told) +
         Line(kLeft, bottom - 10,
              "metres to the right of the line of sight through the middle; metres of height") +
         "</svg>\n";
}

}  // namespace farhorizon
