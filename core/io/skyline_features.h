#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "core/geo/frames.h"

namespace farhorizon {

/// A part of a horizon edge that is the skyline in one direction, as it is published. Each pair has
/// the value at the part's left end and that at its right end, as the viewer has them.
///
/// a, b: [column, row] of the edge's ends. t: position on the edge, 0 at a, 1 at b.
/// offset_m: distance to the viewer's right of the line of sight through the DEM's middle.
/// depth_m: distance beyond that middle along the line of sight. Both are metres on the ground,
///   with columns and rows as long as they are at the middle.
struct SkylineFeature {
  std::array<std::int32_t, 2> a;
  std::array<std::int32_t, 2> b;
  Geodetic left;
  Geodetic right;
  std::array<double, 2> t;
  std::array<double, 2> offset_m;
  std::array<double, 2> depth_m;
};

/// The skyline in one direction, its parts from left to right.
///
/// azimuth: that of `direction`, degrees clockwise from true north at the DEM's middle.
/// direction: [columns, rows]; each line of sight in this direction through a part is a witness.
/// approximate: the skyline was found from a superset of the horizon edges, which has the same
///   skyline.
struct SkylineOfDirection {
  double azimuth = 0;
  std::array<std::int32_t, 2> direction;
  bool approximate = false;
  std::vector<SkylineFeature> parts;
};

/// An RFC 7946 FeatureCollection with a LineString for each part, one part to a line of text; a
/// part across the meridian of 180 degrees is cut there into a MultiLineString of two. t is printed
/// without loss, longitude and latitude to 10^-9 degrees, metres to 10^-4.
std::string WriteSkylineGeoJson(const SkylineOfDirection& skyline);

}  // namespace farhorizon
