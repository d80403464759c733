#pragma once

#include <cmath>
#include <string>

namespace farhorizon {

/// An Arc/Info ASCII grid: hills with a lake of no data.
inline std::string HillyGrid(int columns, int rows) {
  std::string text = "ncols " + std::to_string(columns) + "\nnrows " + std::to_string(rows) +
                     "\nxllcorner 7\nyllcorner 46\ncellsize 0.001\nNODATA_value -9999\n";
  for (int r = 0; r < rows; ++r) {
    for (int c = 0; c < columns; ++c) {
      const double height =
          500 + 60 * std::sin(c / 3.0) + 40 * std::cos(r / 2.5 + c / 8.0) + (c * 7 + r * 13) % 5;
      const bool lake = r / 4 == 2 && c / 5 == 3;
      text += lake ? "-9999 " : std::to_string(std::lround(height)) + " ";
    }
    text += "\n";
  }
  return text;
}

}  // namespace farhorizon
