#pragma once

#include <array>

namespace farhorizon {

/// A step of one column and a step of one row on the ground at one place, in the directions of true
/// east and north; metres, along the ellipsoid. A linear map from the grid to the ground.
struct GroundStep {
  double column_east_m = 0;
  double column_north_m = 0;
  double row_east_m = 0;
  double row_north_m = 0;

  /// [east, north] in metres of a step of `columns` and `rows`.
  [[nodiscard]] std::array<double, 2> ToGround(double columns, double rows) const {
    return {column_east_m * columns + row_east_m * rows,
            column_north_m * columns + row_north_m * rows};
  }

  /// The determinant of the map, in square metres: a cell's area, negative where azimuths rise as
  /// directions turn from columns to rows (rows that run south under columns that run east).
  [[nodiscard]] double SignedCellArea() const {
    return column_east_m * row_north_m - row_east_m * column_north_m;
  }

  /// The azimuth of a step of `columns` and `rows`: degrees clockwise from true north, in
  /// [-180, 180].
  [[nodiscard]] double ToAzimuth(double columns, double rows) const;

  /// The inverse: [columns, rows] of one metre towards `azimuth_deg`.
  /// Requires: SignedCellArea() is not 0.
  [[nodiscard]] std::array<double, 2> ToGrid(double azimuth_deg) const;
};

}  // namespace farhorizon
