#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "core/base/result.h"

namespace farhorizon {

/// A point of a file's mesh, in whatever axes and unit the file has.
using FilePoint = std::array<double, 3>;

/// What a file says of the frame of its points.
enum class FileFrame {
  kUnstated,  ///< the format has no word for it, or the file does not say
  kYUp,       ///< right-handed, y up, metres, the place unstated: glTF by itself
  kTile,      ///< metres east, north and up of farhorizon's frame of the DEM: our .drc
  kEcef,      ///< earth-fixed (EPSG:4978), metres: content of a tileset
};

/// A mesh as a file has it, in doubles. triangles: n x 3 into `points`, wound as in the file.
struct FileMesh {
  std::vector<FilePoint> points;
  std::vector<std::array<std::uint32_t, 3>> triangles;
  FileFrame frame = FileFrame::kUnstated;
  /// Faces of more than three corners, which were cut into fans of triangles.
  std::int64_t polygons = 0;
};

/// What a file may hold, so that no file of a few bytes takes all memory.
struct MeshLimits {
  std::size_t max_points = std::size_t{1} << 27U;
  std::size_t max_triangles = std::size_t{1} << 27U;
  std::uintmax_t max_bytes = std::uintmax_t{4} << 30U;
};

/// `text` of a stranger's file with "?" for each control character, so that no terminal obeys it.
std::string Printable(std::string text);

/// kUnsupportedData, kind "bad-mesh-file"; the message is made printable.
Error BadMeshFile(const std::string& message);

/// Whether so many points and triangles may be read.
/// Errors: kResourceExhausted, kind "mesh-too-large".
Status CheckCounts(std::uint64_t points, std::uint64_t triangles, const MeshLimits& limits);

/// Adds the triangles of a polygon, as a fan about its first corner; none where it has fewer than
/// three corners.
void AddPolygon(const std::vector<std::uint32_t>& corners, FileMesh& mesh);

/// Makes one point of points with equal coordinates and drops points that no triangle uses, and
/// triangles that name a point twice.
/// Errors: kUnsupportedData, kind "bad-mesh-file", where no triangle is there, one names a point
///   that is not there, or a point in use is not finite. Cost: O(n log n).
Status TidyMesh(FileMesh& mesh);

}  // namespace farhorizon
