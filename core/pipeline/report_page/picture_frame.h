#pragma once

#include "core/pipeline/ground_step.h"
#include "core/terrain/dem.h"

namespace farhorizon {

/// How a DEM's plan lies in a picture: the first and the last posts of rows and columns are the
/// picture's sides, the map's north is up. A pixel is made from samples x samples heights.
struct PictureFrame {
  int width = 1;  ///< pixels
  int height = 1;
  int samples = 1;
  double columns = 1;          ///< steps from the first column to the last one
  double rows = 1;             ///< likewise
  bool flips_columns = false;  ///< the first column is on the right
  bool flips_rows = false;     ///< the first row is at the bottom
  double pixel_width_m = 1;
  double pixel_height_m = 1;

  [[nodiscard]] int sample_columns() const { return width * samples; }
  [[nodiscard]] int sample_rows() const { return height * samples; }
  /// Where a column stands among the sample columns, whose middles are whole numbers.
  [[nodiscard]] double SampleX(double column) const {
    return (flips_columns ? columns - column : column) / columns * sample_columns() - 0.5;
  }
  [[nodiscard]] double SampleY(double row) const {
    return (flips_rows ? rows - row : row) / rows * sample_rows() - 0.5;
  }
  /// The inverses.
  [[nodiscard]] double ColumnAt(double x) const {
    const double column = (x + 0.5) / sample_columns() * columns;
    return flips_columns ? columns - column : column;
  }
  [[nodiscard]] double RowAt(double y) const {
    const double row = (y + 0.5) / sample_rows() * rows;
    return flips_rows ? rows - row : row;
  }
  /// Whether a narrow strip is drawn wider than it is.
  [[nodiscard]] bool IsStretched() const;
};

/// The frame of the page's pictures of `dem`, whose cells are as `step` has them.
PictureFrame FrameOf(const Dem& dem, const GroundStep& step);

}  // namespace farhorizon
