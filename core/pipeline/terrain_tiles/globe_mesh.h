#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "core/base/result.h"
#include "core/io/local_mesh.h"
#include "core/pipeline/georeference.h"
#include "core/pipeline/terrain_tiles/fill_plan.h"

namespace farhorizon {

/// Lattice units of 180 degrees of longitude or latitude: one is 0.02 mm, and the sides of tiles up
/// to zoom 40 lie on the lattice. Of a point, x is 0 at the meridian of 180 degrees west, y at the
/// south pole. West or east of a DEM that lies over that meridian x goes on beyond it.
inline constexpr int kLatticeBits = 40;
inline constexpr std::int64_t kHalfTurn = std::int64_t{1} << kLatticeBits;

/// The side of a tile at `zoom`, lattice units.
constexpr std::int64_t TileSide(int zoom) { return kHalfTurn >> zoom; }

/// A vertex of a level as it lies on the globe.
///
/// height_m: above the ellipsoid. normal: earth-fixed. lift_m: by no more than this the vertex lies
/// above the straight edges that it was cut from. is_ground: false for those that are only there to
/// cover the globe beside the DEM.
struct GlobeVertex {
  LatticePoint place;
  double height_m = 0;
  std::array<float, 3> normal = {0, 0, 1};
  float lift_m = 0;
  bool is_ground = true;
};

/// A part of a level, by vertices that it does not own.
///
/// triangles: counter-clockwise in longitude and latitude. walls: what is between the ground's side
/// and the globe beside it; ground a, ground b, with the ground to the left of a to b, and under or
/// over them fill b, fill a.
struct GlobePart {
  std::vector<std::array<std::uint32_t, 3>> triangles;
  std::vector<std::array<std::uint32_t, 4>> walls;
};

/// A level on the globe. ground: its triangles.
struct GlobeMesh {
  std::vector<GlobeVertex> vertices;
  GlobePart ground;
};

/// A rectangle of the lattice.
struct PlaceBox {
  LatticePoint least;
  LatticePoint greatest;
};

/// Puts a decoded level on the globe's lattice. Vertices at one place become one.
/// Errors: those of Georeference::ToGeodetic; kUnsupportedData, kind "too-large-extent", where the
///   level is within 11 km of a pole or goes round one.
Result<GlobeMesh> PlaceOnGlobe(const Georeference& georeference, const LocalMesh& mesh);

/// The least box around the ground's vertices. Requires: there are some.
PlaceBox BoxAround(const GlobeMesh& mesh);

/// Covers all of `box` that is not ground: voids of the ground get triangles from side to side,
/// the globe around it is covered at height 0, with walls between. The parts share vertices.
///
/// Result: all of it, with the ground; the new vertices are appended to mesh.vertices.
/// Requires: the ground lies within the box and does not touch its sides.
/// Errors: those of TriangulateInside.
/// Cost: O(triangles + n log n), n vertices on the ground's sides.
Result<GlobePart> CoverBox(GlobeMesh& mesh, const PlaceBox& box);

/// The earth-fixed direction of the ellipsoid's normal at a place.
std::array<float, 3> UpAt(const LatticePoint& place);

/// Degrees of longitude, within 180 of zero where it is the DEM's, and latitude.
Geodetic GeodeticOf(const LatticePoint& place, double height_m);

}  // namespace farhorizon
