// over_grid DEM MESH.earth OUT.mesh
//
// Puts a mesh that lies on the Earth over the grid of its DEM (grid.h). MESH.earth: int32 vertices,
// int32 triangles; float64 x, y, z a vertex, earth-fixed metres (EPSG:4978); int32 a, b, c a
// triangle.
#include <array>
#include <fstream>
#include <iostream>

#include "grid.h"
#include "raster.h"

int main(int argc, char** argv) {
  using namespace farhorizon::peers;
  if (argc != 4) {
    std::cerr << "usage: over_grid DEM MESH.earth OUT.mesh\n";
    return 2;
  }
  std::ifstream file(argv[2], std::ios::binary);
  const auto read = [&](auto& values) {
    file.read(reinterpret_cast<char*>(values.data()),
              static_cast<std::streamsize>(values.size() * sizeof(values[0])));
  };
  std::array<std::int32_t, 2> counts{};
  read(counts);
  Mesh mesh;
  mesh.vertices.resize(static_cast<std::size_t>(counts[0]));
  mesh.triangles.resize(static_cast<std::size_t>(counts[1]));
  read(mesh.vertices);
  read(mesh.triangles);
  if (!file) Fail(std::string(argv[2]) + ": ends too early, or cannot be read");
  mesh.vertices = Raster(argv[1]).OverGrid(mesh.vertices);
  WriteMesh(mesh, argv[3]);
}
