#include "core/pipeline/report_page/picture_frame.h"

#include <algorithm>
#include <cmath>

namespace farhorizon {

namespace {

// The longer side of a picture, pixels: fills the page's column, and five reliefs of mountains are
// a megabyte.
constexpr int kLongSide = 960;
// The shorter one at least: enough to see, and to click.
constexpr int kShortSide = 48;
// A picture of more posts than pixels is drawn from up to this many heights along a pixel's side;
// 4 at 3840 x 3840 posts. Beyond, some posts are not seen.
constexpr double kMostSamples = 4;

}  // namespace

bool PictureFrame::IsStretched() const {
  return std::max(pixel_width_m, pixel_height_m) > 1.05 * std::min(pixel_width_m, pixel_height_m);
}

PictureFrame FrameOf(const Dem& dem, const GroundStep& step) {
  PictureFrame frame;
  frame.columns = dem.columns - 1;
  frame.rows = dem.rows - 1;
  frame.flips_columns = dem.transform.step_x < 0;
  frame.flips_rows = dem.transform.step_y > 0;
  const double width_m = std::hypot(step.column_east_m, step.column_north_m) * frame.columns;
  const double height_m = std::hypot(step.row_east_m, step.row_north_m) * frame.rows;
  const double longer_m = std::max(width_m, height_m);
  const auto pixels = [longer_m](double side_m) {
    return std::max(static_cast<int>(std::lround(kLongSide * side_m / longer_m)), kShortSide);
  };
  frame.width = pixels(width_m);
  frame.height = pixels(height_m);
  frame.pixel_width_m = width_m / frame.width;
  frame.pixel_height_m = height_m / frame.height;
  const double posts_a_pixel = std::max(frame.columns / frame.width, frame.rows / frame.height);
  frame.samples = static_cast<int>(std::clamp(std::round(posts_a_pixel), 1.0, kMostSamples));
  return frame;
}

}  // namespace farhorizon
