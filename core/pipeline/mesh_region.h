#pragma once

#include <array>
#include <limits>
#include <vector>

#include "core/base/result.h"
#include "core/io/local_mesh.h"
#include "core/io/tileset.h"
#include "core/pipeline/georeference.h"

namespace farhorizon {

/// The least region, in longitude, latitude and height, that holds meshes: also across the meridian
/// of 180 degrees, and around a pole.
class MeshRegion {
 public:
  /// georeference: that of the meshes; outlives this object.
  explicit MeshRegion(const Georeference& georeference) : georeference_(&georeference) {}

  /// Extends the region by a mesh.
  /// Errors: those of Georeference::ToGeodetic. Cost: O(vertices + triangles).
  Status Add(const LocalMesh& mesh);
  /// Extends the region by another, of the same georeference.
  void Add(const MeshRegion& other);

  /// West, south, east and north, radians within [-pi, pi] and [-pi/2, pi/2]; west > east where the
  /// meshes lie on both sides of the meridian of 180 degrees, west -pi and east pi where they go
  /// all the way round. The least height is below all of the ground: edges are straight, so that
  /// what is between their ends sinks below the curved Earth.
  ///
  /// slack_m: a side that is over the meridian by no more than this is put on it: vertices are
  /// rounded, those of a tile that ends there too.
  /// Requires: a mesh was added.
  [[nodiscard]] BoundingRegion Box(double slack_m) const;

 private:
  // The longitudes of the meshes within one degree; none where least > greatest.
  struct Span {
    double least = 360;
    double greatest = -360;
    bool crossed = false;  ///< by an edge, whether or not a vertex is here
  };

  void AddPoint(const Geodetic& p);
  void AddEdge(const Geodetic& a, const Geodetic& b);
  void AddTriangle(const std::array<Geodetic, 3>& corners);

  const Georeference* georeference_;
  std::array<Span, 360> spans_ = {};
  double south_ = 90;
  double north_ = -90;
  double least_m_ = std::numeric_limits<double>::infinity();
  double greatest_m_ = -std::numeric_limits<double>::infinity();
  double longest_m_ = 0;  // edge
};

}  // namespace farhorizon
