// The shade of a sample is the cosine between the surface's normal and the light, as Lambert has
// it, from differences to the samples beside it. A pixel is the mean of its samples' shades.
#include "core/pipeline/report_page/relief.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace farhorizon {

namespace {

// Heights above and beside each other, by the sample.
class Slopes {
 public:
  Slopes(const HeightRaster& raster, const PictureFrame& frame)
      : heights_(raster.heights_m.data()),
        columns_(frame.sample_columns()),
        rows_(frame.sample_rows()),
        step_x_m_(frame.pixel_width_m / frame.samples),
        step_y_m_(frame.pixel_height_m / frame.samples) {}

  [[nodiscard]] bool Has(int x, int y) const { return !std::isnan(At(x, y)); }
  // Rise in metres a metre to the right, and downwards on the picture.
  [[nodiscard]] double ToRight(int x, int y) const {
    return Rise(At(x, y), At(std::max(x - 1, 0), y), At(std::min(x + 1, columns_ - 1), y)) /
           step_x_m_;
  }
  [[nodiscard]] double Down(int x, int y) const {
    return Rise(At(x, y), At(x, std::max(y - 1, 0)), At(x, std::min(y + 1, rows_ - 1))) / step_y_m_;
  }

 private:
  [[nodiscard]] float At(int x, int y) const {
    return heights_[static_cast<std::size_t>(y) * static_cast<std::size_t>(columns_) +
                    static_cast<std::size_t>(x)];
  }
  // The rise a step at `here`; a neighbour that is missing is left out.
  static double Rise(double here, double before, double after) {
    if (std::isnan(before)) return std::isnan(after) ? 0 : after - here;
    return std::isnan(after) ? here - before : (after - before) / 2;
  }

  const float* heights_;
  int columns_;
  int rows_;
  double step_x_m_;
  double step_y_m_;
};

// Towards the light: upper left, 45 degrees high. On the picture y runs downwards.
constexpr double kLightX = -0.5;
constexpr double kLightY = -0.5;
constexpr double kLightUp = 0.70710678118654752;

// 25 (black is for nothing) for slopes that the light does not reach, 196 for level ground.
constexpr double kDarkest = 25;
constexpr double kBrightness = (196 - kDarkest) / kLightUp;
constexpr double kNoSurface = 255;

double ShadeOf(double to_right, double down) {
  // The normal is (-to_right, -down, 1) over its length.
  const double cosine = (kLightUp - kLightX * to_right - kLightY * down) /
                        std::sqrt(1 + to_right * to_right + down * down);
  return std::min(kDarkest + kBrightness * std::max(cosine, 0.0), 250.0);
}

}  // namespace

double ReliefExaggeration(const HeightRaster& raster, const PictureFrame& frame) {
  // Drawn with slopes of about this root mean square, mountains and plains read well.
  constexpr double kWantedSlope = 0.35;
  const Slopes slopes(raster, frame);
  double squares = 0;
  std::int64_t count = 0;
  for (int y = 0; y < frame.sample_rows(); ++y) {
    for (int x = 0; x < frame.sample_columns(); ++x) {
      if (!slopes.Has(x, y)) continue;
      squares += std::pow(slopes.ToRight(x, y), 2) + std::pow(slopes.Down(x, y), 2);
      ++count;
    }
  }
  if (count == 0 || !(squares > 0)) return 1;
  // Beyond, floats and lattices would be seen instead of ground.
  constexpr double kMost = 1000;
  const double wanted =
      std::min(kWantedSlope / std::sqrt(squares / static_cast<double>(count)), kMost);
  const double power = std::pow(10.0, std::floor(std::log10(wanted)));
  const double digit = wanted / power;
  return power * (digit < 1.5 ? 1 : digit < 3.5 ? 2 : digit < 7.5 ? 5 : 10);
}

GreyPicture ShadedRelief(const HeightRaster& raster, const PictureFrame& frame,
                         double exaggeration) {
  const Slopes slopes(raster, frame);
  GreyPicture picture{frame.width, frame.height, {}};
  picture.values.reserve(static_cast<std::size_t>(frame.width) *
                         static_cast<std::size_t>(frame.height));
  std::vector<double> sums(static_cast<std::size_t>(frame.width));
  const double samples = frame.samples * frame.samples;
  for (int y = 0; y < frame.sample_rows(); ++y) {
    for (int x = 0; x < frame.sample_columns(); ++x) {
      sums[static_cast<std::size_t>(x / frame.samples)] +=
          slopes.Has(x, y)
              ? ShadeOf(exaggeration * slopes.ToRight(x, y), exaggeration * slopes.Down(x, y))
              : kNoSurface;
    }
    if ((y + 1) % frame.samples != 0) continue;
    for (double& sum : sums) {
      picture.values.push_back(static_cast<std::uint8_t>(sum / samples + 0.5));
      sum = 0;
    }
  }
  return picture;
}

}  // namespace farhorizon
