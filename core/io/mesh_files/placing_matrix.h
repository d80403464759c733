#pragma once

#include <array>

#include "core/io/mesh_files/file_mesh.h"

namespace farhorizon {

/// A 4 x 4 matrix, column-major, as glTF and 3D Tiles have them. Points are columns; the last row
/// is taken for 0 0 0 1.
using PlacingMatrix = std::array<double, 16>;

inline constexpr PlacingMatrix kIdentity = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1};
/// From y up to z up, as 3D Tiles turns the content of a tile ([3D Tiles], "glTF transforms").
inline constexpr PlacingMatrix kYUpToZUp = {1, 0, 0, 0, 0, 0, 1, 0, 0, -1, 0, 0, 0, 0, 0, 1};

/// The matrix that does `inner` first.
PlacingMatrix Multiply(const PlacingMatrix& outer, const PlacingMatrix& inner);

FilePoint Apply(const PlacingMatrix& matrix, const FilePoint& p);

/// Whether the matrix turns left to right: triangles have the other winding then.
bool Mirrors(const PlacingMatrix& matrix);

/// The matrix of translation, rotation (a quaternion x, y, z, w) and scale, as glTF's nodes have
/// them.
PlacingMatrix MatrixOf(const FilePoint& translation, const std::array<double, 4>& rotation,
                       const FilePoint& scale);

/// Places all points of `mesh`, and turns its triangles where the matrix mirrors.
void Place(const PlacingMatrix& matrix, FileMesh& mesh);

}  // namespace farhorizon
