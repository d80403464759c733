#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "core/geo/frames.h"

namespace farhorizon {

/// A part of a horizon edge that is the skyline in one direction, as it is published. Pairs: its left end
/// and its right end, as the viewer has them.
///
/// a, b: [column, row]. t: 0 at a, 1 at b. offset_m: to the viewer's right of the line of sight through the
/// DEM's middle; depth_m: beyond that middle along it. Both on the ground as it is at the middle.
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
/// azimuth: degrees clockwise from true north at the DEM's middle. direction: [columns, rows], along which
/// every line of sight through a part is a witness. approximate: the horizon that it was found from is a
/// superset; the skyline is the same.
struct SkylineOfDirection {
  double azimuth = 0;
  std::array<std::int32_t, 2> direction;
  bool approximate = false;
  std::vector<SkylineFeature> parts;
};

/// An RFC 7946 FeatureCollection, a LineString a part, one part a line of text. t is printed without loss,
/// places to 10^-9 degrees, metres to 10^-4.
std::string WriteSkylineGeoJson(const SkylineOfDirection& skyline);

/// A picture of it, as SVG: what stands against the sky, heights drawn larger than distances as the picture
/// says, parts the lighter the farther away. title: one line, any text. The same skyline, the same bytes.
std::string DrawSkyline(const SkylineOfDirection& skyline, const std::string& title);

}  // namespace farhorizon
