// judge DEM.grid CELL_X CELL_Y MESH.mesh...
//
// Prints a JSON object a line for each mesh: its errors against the DEM. It judges whatever
// triangles it is given, knows nothing of how they were made and shares no code with farhorizon.
// Files: grid.h.
#include <cstdlib>
#include <iomanip>
#include <iostream>
#include <string>

#include "grid.h"
#include "skylines.h"
#include "surfaces.h"

int main(int argc, char** argv) {
  using namespace farhorizon::peers;
  if (argc < 5) {
    std::cerr << "usage: judge DEM.grid CELL_X CELL_Y MESH.mesh...\n";
    return 2;
  }
  const Grid grid = ReadGrid(argv[1]);
  const Cell cell{std::atof(argv[2]), std::atof(argv[3])};
  if (!(cell.x > 0 && cell.y > 0)) Fail("the size of a cell is a number of metres");

  constexpr int kDirections = 96, kLinesPerCell = 2;
  const Skylines skylines(grid, kDirections, kLinesPerCell);
  std::cout << std::setprecision(10);
  for (int i = 4; i < argc; ++i) {
    const Mesh mesh = ReadMesh(argv[i]);
    const SilhouetteErrors silhouette = skylines.ErrorsOf(mesh);
    const VerticalErrors vertical = VerticalErrorsOf(mesh, grid);
    std::cout << "{\"triangles\": " << mesh.triangles.size()
              << ", \"vertices\": " << mesh.vertices.size()
              << ", \"silhouette_rms_m\": " << silhouette.rms
              << ", \"silhouette_max_m\": " << silhouette.max
              << ", \"silhouette_rim_max_m\": " << silhouette.rim_max
              << ", \"lines_missed\": " << silhouette.missed
              << ", \"vertical_rms_m\": " << vertical.rms
              << ", \"vertical_max_m\": " << vertical.max
              << ", \"posts_uncovered\": " << vertical.uncovered
              << ", \"facet_angle_rms_deg\": " << FacetAngleRms(mesh, grid, cell)
              << ", \"needles_percent\": " << 100 * NeedleShare(mesh, cell, 2) << "}" << std::endl;
  }
}
