#include "core/io/mesh_files/placing_matrix.h"

#include <utility>

namespace farhorizon {

PlacingMatrix Multiply(const PlacingMatrix& outer, const PlacingMatrix& inner) {
  PlacingMatrix product{};
  for (std::size_t column = 0; column < 4; ++column) {
    for (std::size_t row = 0; row < 4; ++row) {
      for (std::size_t k = 0; k < 4; ++k) {
        product[4 * column + row] += outer[4 * k + row] * inner[4 * column + k];
      }
    }
  }
  return product;
}

FilePoint Apply(const PlacingMatrix& matrix, const FilePoint& p) {
  FilePoint placed{};
  for (std::size_t row = 0; row < 3; ++row) {
    placed[row] =
        matrix[row] * p[0] + matrix[4 + row] * p[1] + matrix[8 + row] * p[2] + matrix[12 + row];
  }
  return placed;
}

bool Mirrors(const PlacingMatrix& m) {
  return m[0] * (m[5] * m[10] - m[6] * m[9]) - m[4] * (m[1] * m[10] - m[2] * m[9]) +
             m[8] * (m[1] * m[6] - m[2] * m[5]) <
         0;
}

PlacingMatrix MatrixOf(const FilePoint& translation, const std::array<double, 4>& rotation,
                       const FilePoint& scale) {
  const auto& [x, y, z, w] = rotation;
  const auto& [tx, ty, tz] = translation;
  const auto& [sx, sy, sz] = scale;
  return {(1 - 2 * (y * y + z * z)) * sx,
          2 * (x * y + z * w) * sx,
          2 * (x * z - y * w) * sx,
          0,
          2 * (x * y - z * w) * sy,
          (1 - 2 * (x * x + z * z)) * sy,
          2 * (y * z + x * w) * sy,
          0,
          2 * (x * z + y * w) * sz,
          2 * (y * z - x * w) * sz,
          (1 - 2 * (x * x + y * y)) * sz,
          0,
          tx,
          ty,
          tz,
          1};
}

void Place(const PlacingMatrix& matrix, FileMesh& mesh) {
  for (FilePoint& p : mesh.points) p = Apply(matrix, p);
  if (!Mirrors(matrix)) return;
  for (auto& t : mesh.triangles) std::swap(t[1], t[2]);
}

}  // namespace farhorizon
