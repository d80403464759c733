#pragma once

#include <cstdint>
#include <optional>

#include "core/measure/mesh_error.h"
#include "core/measure/mesh_sides.h"
#include "core/terrain/dem.h"

namespace farhorizon {

/// Distances along the verticals of a DEM's posts to a mesh, in the frame in which it is straight.
class Verticals {
 public:
  /// Requires: all four outlive it; places and mesh.straight are given both or neither.
  Verticals(const Dem& dem, const PostPlaces& places, const PlacedMesh& mesh,
            const MeshSides& sides)
      : dem_(dem), places_(places), mesh_(mesh), sides_(sides) {}

  /// From post v to the triangle that its vertical meets: `triangle`, which has the post in plan,
  /// or one that is found from there. nullopt: the vertical leaves the mesh. Metres.
  [[nodiscard]] std::optional<double> DistanceAt(VertexId v, std::int32_t triangle) const;

  /// From post v to the point at the share t of the way from side.a to side.b. with_plane: or to
  /// the plane of the triangle there, if that is further. Metres.
  /// Requires: one triangle is at the side.
  [[nodiscard]] double DistanceAtOutline(VertexId v, const MeshSide& side, double t,
                                         bool with_plane) const;

 private:
  struct Meeting;

  [[nodiscard]] StraightPoint Straight(std::int32_t point) const;
  [[nodiscard]] StraightPoint PlaceOf(VertexId v) const;
  [[nodiscard]] StraightPoint UpAt(const StraightPoint& p) const;
  [[nodiscard]] Meeting Meet(std::int32_t triangle, const StraightPoint& post,
                             const StraightPoint& up) const;
  [[nodiscard]] std::int32_t ThirdOf(std::int32_t triangle, const MeshSide& side) const;

  const Dem& dem_;
  const PostPlaces& places_;
  const PlacedMesh& mesh_;
  const MeshSides& sides_;
};

}  // namespace farhorizon
