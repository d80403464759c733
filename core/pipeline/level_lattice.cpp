// How finely a level's vertices are rounded. Steps are powers of two that follow from the level's
// error and the cell's size alone, so that tiles which know nothing of one another round the posts
// that they share alike; they become finer only where rounding would flip a triangle, and coarser
// only where the lattice would have more steps than Draco's bits.
#include "core/pipeline/level_lattice.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

#include "core/geo/ellipsoid_normal.h"
#include "core/pipeline/mesh_orientation.h"
#include "core/terrain/border.h"

namespace farhorizon {

namespace {

// The greatest power of two that is not above `value`.
double PowerOfTwoWithin(double value) {
  int exponent = 0;
  std::frexp(value, &exponent);  // 2^(exponent - 1) <= value < 2^exponent
  return std::ldexp(1.0, exponent - 1);
}

// To the nearest multiple, halves up, and what is a 4096th below a half, too. Right below the
// origin of a frame heights in whole metres may be halves of a step; elsewhere nothing is but by
// accident. What PROJ leaves in the last bits must not decide them, in either of two tiles.
Enu Rounded(const Enu& p, double step) {
  constexpr double kHalf = 0.5 + 1.0 / 4096;
  const auto round = [step](double x) { return std::floor(x / step + kHalf) * step; };
  return {round(p.east), round(p.north), round(p.up)};
}

std::vector<Enu> Rounded(const Dem& dem, const LatticeSteps& steps, const LocalMesh& mesh) {
  std::vector<Enu> rounded;
  rounded.reserve(mesh.positions.size());
  for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
    const bool on_side = OnSide(dem, static_cast<VertexId>(mesh.posts[i]));
    rounded.push_back(Rounded(mesh.positions[i], on_side ? steps.sides_m : steps.inside_m));
  }
  return rounded;
}

// Two corners of the box around what is `room_m` below `points`.
std::array<Enu, 2> RoomBelow(const std::vector<Enu>& points, const TangentFrame& frame,
                             double room_m) {
  constexpr double kFar = std::numeric_limits<double>::infinity();
  std::array<Enu, 2> room = {Enu{kFar, kFar, kFar}, Enu{-kFar, -kFar, -kFar}};
  for (const Enu& p : points) {
    const Enu up = EllipsoidNormal(p, frame);
    const double share = -room_m / std::hypot(up.east, up.north, up.up);
    const Enu q = {p.east + share * up.east, p.north + share * up.north, p.up + share * up.up};
    room[0] = {std::min(room[0].east, q.east), std::min(room[0].north, q.north),
               std::min(room[0].up, q.up)};
    room[1] = {std::max(room[1].east, q.east), std::max(room[1].north, q.north),
               std::max(room[1].up, q.up)};
  }
  return room;
}

}  // namespace

double FinestSideStep(const Georeference& georeference, double max_error_m) {
  const double step = std::min(PowerOfTwoWithin(georeference.row_step_m() / 175), 0.5);
  // Half a step is an eighth of the error on level ground, and as much again on a slope of 45
  // degrees.
  return max_error_m > 0 ? std::min(step, PowerOfTwoWithin(max_error_m / 4)) : step;
}

LatticeSteps StepsOfLevel(double finest_side_m, const Georeference& georeference, const Lod& lod,
                          int number) {
  const double cell_m = std::min(georeference.column_step_m(), georeference.row_step_m());
  LatticeSteps steps;
  steps.sides_m = std::min(std::ldexp(finest_side_m, number), PowerOfTwoWithin(cell_m / 16));
  const double wanted = lod.exact ? lod.vertical_rms_m / 4
                                  : std::max(1.25 * lod.silhouette_rms_m, lod.vertical_rms_m / 32);
  steps.inside_m = steps.sides_m;
  if (wanted > 0) steps.inside_m = std::min(steps.sides_m, PowerOfTwoWithin(wanted));
  return steps;
}

Result<QuantizationLattice> RoundToLattice(const Dem& dem, const TangentFrame& frame,
                                           LatticeSteps& steps, LocalMesh& mesh, double room_m) {
  const std::vector<Enu> exact = mesh.positions;
  bool finer = false;
  while (true) {
    std::vector<Enu> rounded = Rounded(dem, steps, {exact, mesh.posts, {}, {}});
    std::vector<Enu> reach = rounded;
    if (room_m > 0) {
      // Two steps for the rounding of what is down there.
      const auto below = RoomBelow(rounded, frame, room_m + 2 * steps.inside_m);
      reach.insert(reach.end(), below.begin(), below.end());
    }
    const QuantizationLattice lattice = ChooseLattice(reach, steps.inside_m);
    const bool reaches = lattice.step_m == steps.inside_m;
    if (!reaches && finer) {
      return Error{ErrorCode::kUnsupportedData,
                   "a triangle is flipped or flat, however finely its vertices are rounded: the "
                   "DEM's rows or columns bend too much on the ground, as around a pole; warp it "
                   "to a system in which they are straight, a polar one there, with gdalwarp "
                   "-r bilinear -ot Float32 -dstnodata -9999 -t_srs CRS IN OUT.tif, or cut it into "
                   "parts with gdal_translate -srcwin",
                   "flipped-triangle"};
    }
    if (!reaches) {
      steps.inside_m = lattice.step_m;
      steps.sides_m = std::max(steps.sides_m, steps.inside_m);
      continue;
    }
    mesh.positions = std::move(rounded);
    if (AllTurnLeft(mesh, frame)) return lattice;
    finer = true;
    steps.inside_m /= 2;
    steps.sides_m /= 2;
  }
}

}  // namespace farhorizon
