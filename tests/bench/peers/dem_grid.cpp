// dem_grid DEM OUT.grid
//
// Writes the first band of a raster as a grid in metres (grid.h) and prints what the contest has to
// know of it, as a JSON object.
#include <algorithm>
#include <cmath>
#include <iomanip>
#include <iostream>

#include "grid.h"
#include "raster.h"

int main(int argc, char** argv) {
  using namespace farhorizon::peers;
  if (argc != 3) {
    std::cerr << "usage: dem_grid DEM OUT.grid\n";
    return 2;
  }
  const Raster raster(argv[1]);
  const Grid grid = raster.Heights();
  const auto [cell_x, cell_y] = raster.CellMetres();
  WriteGrid(grid, argv[2]);

  const auto missing = std::count_if(grid.heights.begin(), grid.heights.end(),
                                     [](float height) { return std::isnan(height); });
  std::cout << std::setprecision(12) << "{\"columns\": " << grid.columns
            << ", \"rows\": " << grid.rows << ", \"cell_x_m\": " << cell_x
            << ", \"cell_y_m\": " << cell_y << ", \"missing_posts\": " << missing
            << ", \"triangles\": " << FullMesh(grid).triangles.size()
            << ", \"system_to_state\": " << std::quoted(raster.SystemToState()) << "}\n";
}
