// The bytes of a tile, little-endian, as [Quantized-mesh] has them and CesiumTerrainProvider reads
// them. Indices are coded against the highest one so far, which needs vertices in the order of
// their first use.
#include "core/io/quantized_mesh/quantized_mesh.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <optional>
#include <type_traits>

#include "core/base/result.h"
#include "core/geo/ellipsoid.h"
#include "core/io/quantized_mesh/horizon_occlusion.h"

namespace farhorizon {

namespace {

constexpr std::size_t kMostShortVertices = 65536;
constexpr std::uint8_t kOctVertexNormals = 1;
constexpr std::uint8_t kMetadata = 4;

class Bytes {
 public:
  template <typename Number>
  void Add(Number value) {
    if constexpr (std::is_same_v<Number, double>) {
      AddWhole(std::bit_cast<std::uint64_t>(value));
    } else if constexpr (std::is_same_v<Number, float>) {
      AddWhole(std::bit_cast<std::uint32_t>(value));
    } else {
      AddWhole(value);
    }
  }
  void Add(const Ecef& p) {
    Add(p.x);
    Add(p.y);
    Add(p.z);
  }
  void Add(const std::string& text) { bytes_ += text; }
  void PadTo(std::size_t multiple) {
    while (bytes_.size() % multiple != 0) bytes_ += '\0';
  }
  std::string Take() && { return std::move(bytes_); }

 private:
  template <typename Whole>
  void AddWhole(Whole value) {
    static_assert(std::is_unsigned_v<Whole>);
    for (std::size_t i = 0; i < sizeof(Whole); ++i) {
      bytes_ += static_cast<char>(static_cast<std::uint64_t>(value) >> (8 * i) & 0xFFU);
    }
  }

  std::string bytes_;
};

// The vertices in the order of their first use, and the triangles that name them so.
struct Renumbered {
  std::vector<QuantizedVertex> vertices;
  std::vector<std::uint32_t> indices;
};

Renumbered InOrderOfUse(const QuantizedTile& tile) {
  constexpr std::uint32_t kNone = std::numeric_limits<std::uint32_t>::max();
  std::vector<std::uint32_t> number(tile.vertices.size(), kNone);
  Renumbered result;
  result.vertices.reserve(tile.vertices.size());
  result.indices.reserve(tile.triangles.size() * 3);
  for (const auto& triangle : tile.triangles) {
    for (const std::uint32_t corner : triangle) {
      if (number[corner] == kNone) {
        number[corner] = static_cast<std::uint32_t>(result.vertices.size());
        result.vertices.push_back(tile.vertices[corner]);
      }
      result.indices.push_back(number[corner]);
    }
  }
  Check(result.vertices.size() == tile.vertices.size(), "each vertex of a tile is in a triangle");
  return result;
}

void AddHeader(const QuantizedTile& tile, Bytes& bytes) {
  std::vector<Ecef> places;
  places.reserve(tile.vertices.size());
  for (const QuantizedVertex& vertex : tile.vertices)
    places.push_back(EcefOf(PlaceOf(tile, vertex)));
  const BoundingSphere sphere = SphereAround(places);
  const std::optional<Ecef> occlusion =
      HorizonOcclusionPoint(places, sphere.centre, tile.heights_m[0]);
  constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
  bytes.Add(sphere.centre);
  bytes.Add(tile.heights_m[0]);
  bytes.Add(tile.heights_m[1]);
  bytes.Add(sphere.centre);
  bytes.Add(sphere.radius_m);
  bytes.Add(occlusion.value_or(Ecef{kNone, kNone, kNone}));
}

// Differences from vertex to vertex, the sign in the lowest bit.
void AddCoordinates(const std::vector<QuantizedVertex>& vertices,
                    std::uint16_t QuantizedVertex::*coordinate, Bytes& bytes) {
  int last = 0;
  for (const QuantizedVertex& vertex : vertices) {
    const int difference = vertex.*coordinate - last;
    last = vertex.*coordinate;
    bytes.Add(static_cast<std::uint16_t>(difference >= 0 ? 2 * difference : -2 * difference - 1));
  }
}

void AddIndex(std::uint32_t index, bool is_short, Bytes& bytes) {
  if (is_short) {
    bytes.Add(static_cast<std::uint16_t>(index));
  } else {
    bytes.Add(index);
  }
}

// The vertices of one side: those whose `across` has the value `at`, in the order in which they
// come along it.
void AddSide(const std::vector<QuantizedVertex>& vertices, std::uint16_t QuantizedVertex::*across,
             int at, Bytes& bytes) {
  std::vector<std::uint32_t> side;
  for (std::uint32_t i = 0; i < vertices.size(); ++i) {
    if (vertices[i].*across == at) side.push_back(i);
  }
  const bool meridian = across == &QuantizedVertex::u;
  const auto along = meridian ? &QuantizedVertex::v : &QuantizedVertex::u;
  // Round the tile, as CesiumJS sorts them: northwards in the west, eastwards in the north.
  const bool rising = meridian == (at == 0);
  std::stable_sort(side.begin(), side.end(), [&](std::uint32_t a, std::uint32_t b) {
    return rising ? vertices[a].*along < vertices[b].*along
                  : vertices[a].*along > vertices[b].*along;
  });
  bytes.Add(static_cast<std::uint32_t>(side.size()));
  for (const std::uint32_t i : side) AddIndex(i, vertices.size() <= kMostShortVertices, bytes);
}

// A direction on the octahedron, in two bytes [MeyerEtAl10].
std::array<std::uint8_t, 2> OctahedronOf(const std::array<float, 3>& normal) {
  const double x = normal[0];
  const double y = normal[1];
  const double z = normal[2];
  const double sum = std::abs(x) + std::abs(y) + std::abs(z);
  double u = x / sum;
  double v = y / sum;
  if (z < 0) {
    const double folded_u = (1 - std::abs(v)) * (u < 0 ? -1 : 1);
    v = (1 - std::abs(u)) * (v < 0 ? -1 : 1);
    u = folded_u;
  }
  const auto byte = [](double value) {
    return static_cast<std::uint8_t>(std::lround((std::clamp(value, -1.0, 1.0) + 1) / 2 * 255));
  };
  return {byte(u), byte(v)};
}

}  // namespace

Geodetic PlaceOf(const QuantizedTile& tile, const QuantizedVertex& vertex) {
  const auto between = [](double from, double to, std::uint16_t at) {
    const double share = static_cast<double>(at) / kMostQuantized;
    return (1 - share) * from + share * to;
  };
  return {between(tile.rectangle.west, tile.rectangle.east, vertex.u),
          between(tile.rectangle.south, tile.rectangle.north, vertex.v),
          between(tile.heights_m[0], tile.heights_m[1], vertex.height)};
}

std::string EncodeQuantizedMesh(const QuantizedTile& tile, const std::string& metadata) {
  Check(!tile.triangles.empty(), "a tile has triangles");
  const Renumbered mesh = InOrderOfUse(tile);
  const bool is_short = mesh.vertices.size() <= kMostShortVertices;
  Bytes bytes;
  AddHeader(tile, bytes);
  bytes.Add(static_cast<std::uint32_t>(mesh.vertices.size()));
  AddCoordinates(mesh.vertices, &QuantizedVertex::u, bytes);
  AddCoordinates(mesh.vertices, &QuantizedVertex::v, bytes);
  AddCoordinates(mesh.vertices, &QuantizedVertex::height, bytes);
  bytes.PadTo(is_short ? sizeof(std::uint16_t) : sizeof(std::uint32_t));
  bytes.Add(static_cast<std::uint32_t>(mesh.indices.size() / 3));
  std::uint32_t highest = 0;
  for (const std::uint32_t index : mesh.indices) {
    AddIndex(highest - index, is_short, bytes);
    if (index == highest) ++highest;
  }
  AddSide(mesh.vertices, &QuantizedVertex::u, 0, bytes);
  AddSide(mesh.vertices, &QuantizedVertex::v, 0, bytes);
  AddSide(mesh.vertices, &QuantizedVertex::u, kMostQuantized, bytes);
  AddSide(mesh.vertices, &QuantizedVertex::v, kMostQuantized, bytes);
  bytes.Add(kOctVertexNormals);
  bytes.Add(static_cast<std::uint32_t>(2 * mesh.vertices.size()));
  for (const QuantizedVertex& vertex : mesh.vertices) {
    for (const std::uint8_t byte : OctahedronOf(vertex.normal)) bytes.Add(byte);
  }
  bytes.Add(kMetadata);
  bytes.Add(static_cast<std::uint32_t>(sizeof(std::uint32_t) + metadata.size()));
  bytes.Add(static_cast<std::uint32_t>(metadata.size()));
  bytes.Add(metadata);
  return std::move(bytes).Take();
}

}  // namespace farhorizon
