#pragma once

#include "core/terrain/mesh.h"
#include "core/terrain/terrain.h"

namespace farhorizon {

/// All triangles of a terrain, as a mesh with a point for each post.
inline GridMesh WholeMesh(const Terrain& terrain) {
  const Dem& dem = terrain.dem();
  GridMesh mesh;
  for (VertexId v = 0; v < terrain.post_count(); ++v) {
    mesh.points.push_back({static_cast<double>(dem.Column(v)), static_cast<double>(dem.Row(v)),
                           dem.HasData(v) ? dem.HeightM(v) : 0});
  }
  for (const Triangle& t : terrain.Triangles()) mesh.triangles.push_back({t[0], t[1], t[2]});
  return mesh;
}

}  // namespace farhorizon
