// cgal_meshes DEM.grid CELL_X CELL_Y lt|gh PREFIX TRIANGLES...
//
// Collapses the edges of the full grid with CGAL's policies of Lindstrom and Turk (lt)
// [LindstromTurk98] or of Garland and Heckbert (gh) [GarlandHeckbert97], and writes
// PREFIX-TRIANGLES.mesh whenever no more than TRIANGLES are left: one run for all sizes, each the
// mesh that a run of its own would give. Prints a JSON object a mesh. Vertices leave the posts in
// plan, too; cells in metres. CGAL's mesh simplification is under the GPL, and so is this program
// once it is built: it is run as a process of its own and linked into nothing.
#include <CGAL/Polygon_mesh_processing/orient_polygon_soup.h>
#include <CGAL/Polygon_mesh_processing/polygon_soup_to_polygon_mesh.h>
#include <CGAL/Simple_cartesian.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/Surface_mesh_simplification/Policies/Edge_collapse/GarlandHeckbert_policies.h>
#include <CGAL/Surface_mesh_simplification/edge_collapse.h>
#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <functional>
#include <iostream>
#include <string>
#include <vector>

#include "grid.h"

namespace {

using farhorizon::peers::FullMesh;
using farhorizon::peers::Grid;
using farhorizon::peers::Mesh;
using Kernel = CGAL::Simple_cartesian<double>;
using Surface = CGAL::Surface_mesh<Kernel::Point_3>;
using Clock = std::chrono::steady_clock;

struct Cell {
  double x, y;
};

/// The full grid in metres. Where two fans of triangles share only a post, CGAL gets a vertex for
/// each.
Surface SurfaceOf(const Grid& grid, Cell cell) {
  const Mesh full = FullMesh(grid);
  std::vector<Kernel::Point_3> points;
  std::vector<std::size_t> number(full.vertices.size());
  for (std::size_t post = 0; post < full.vertices.size(); ++post) {
    if (!grid.Has(post)) continue;
    number[post] = points.size();
    const auto& p = full.vertices[post];
    points.emplace_back(p.x * cell.x, p.y * cell.y, p.z);
  }
  std::vector<std::vector<std::size_t>> triangles;
  for (const auto& t : full.triangles) {
    const auto at = [&](int i) { return number[static_cast<std::size_t>(t[i])]; };
    triangles.push_back({at(0), at(1), at(2)});
  }
  namespace processing = CGAL::Polygon_mesh_processing;
  processing::orient_polygon_soup(points, triangles);
  Surface surface;
  processing::polygon_soup_to_polygon_mesh(points, triangles, surface);
  return surface;
}

Mesh MeshOf(const Surface& surface, Cell cell) {
  Mesh mesh;
  std::vector<std::int32_t> number(surface.num_vertices(), -1);  // with the removed ones
  for (const auto face : surface.faces()) {
    std::array<std::int32_t, 3> triangle{};
    std::size_t corner = 0;
    for (const auto vertex : CGAL::vertices_around_face(surface.halfedge(face), surface)) {
      std::int32_t& own = number[vertex.idx()];
      if (own < 0) {
        own = static_cast<std::int32_t>(mesh.vertices.size());
        const auto& p = surface.point(vertex);
        mesh.vertices.push_back({p.x() / cell.x, p.y() / cell.y, p.z()});
      }
      triangle[corner++] = own;
    }
    mesh.triangles.push_back(triangle);
  }
  return mesh;
}

/// CGAL asks before each collapse whether to stop: here the surface is as the collapses left it.
class StopAtLastSize {
 public:
  StopAtLastSize(std::vector<std::size_t> sizes, std::function<void(std::size_t)> on_size)
      : sizes_(std::move(sizes)), on_size_(std::move(on_size)) {
    std::sort(sizes_.begin(), sizes_.end());
  }
  template <typename Cost, typename Profile>
  bool operator()(const Cost&, const Profile& profile, std::size_t, std::size_t) const {
    while (!sizes_.empty() && profile.surface_mesh().number_of_faces() <= sizes_.back()) {
      on_size_(sizes_.back());
      sizes_.pop_back();
    }
    return sizes_.empty();
  }

 private:
  mutable std::vector<std::size_t> sizes_;  // CGAL asks a const object
  std::function<void(std::size_t)> on_size_;
};

}  // namespace

int main(int argc, char** argv) {
  const std::string policy = argc > 4 ? argv[4] : "";
  if (argc < 7 || (policy != "lt" && policy != "gh")) {
    std::cerr << "usage: cgal_meshes DEM.grid CELL_X CELL_Y lt|gh PREFIX TRIANGLES...\n";
    return 2;
  }
  const Cell cell{std::atof(argv[2]), std::atof(argv[3])};
  const std::string prefix = argv[5];
  std::vector<std::size_t> sizes;
  for (int i = 6; i < argc; ++i) sizes.push_back(std::strtoull(argv[i], nullptr, 10));
  Surface surface = SurfaceOf(farhorizon::peers::ReadGrid(argv[1]), cell);

  Clock::time_point begin = Clock::now();
  const StopAtLastSize stop(sizes, [&](std::size_t size) {
    const Clock::time_point paused = Clock::now();
    const Mesh mesh = MeshOf(surface, cell);
    WriteMesh(mesh, prefix + "-" + std::to_string(size) + ".mesh");
    std::cout << "{\"asked\": " << size << ", \"triangles\": " << mesh.triangles.size()
              << ", \"seconds\": " << std::chrono::duration<double>(paused - begin).count() << "}"
              << std::endl;
    begin += Clock::now() - paused;  // writing is not simplifying
  });
  namespace simplification = CGAL::Surface_mesh_simplification;
  if (policy == "gh") {
    const simplification::GarlandHeckbert_plane_policies<Surface, Kernel> quadrics(surface);
    simplification::edge_collapse(
        surface, stop,
        CGAL::parameters::get_cost(quadrics.get_cost()).get_placement(quadrics.get_placement()));
  } else {
    simplification::edge_collapse(surface, stop);
  }
}
