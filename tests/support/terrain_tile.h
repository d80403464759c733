#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <numbers>
#include <stdexcept>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "core/geo/frames.h"

namespace farhorizon {

/// A tile of quantized-mesh as a client reads it, by the specification alone.
struct TerrainTile {
  Ecef centre;
  std::array<float, 2> heights_m;
  Ecef sphere;
  double sphere_m;
  Ecef occlusion;
  std::vector<std::array<int, 3>> vertices;  ///< u, v, height
  std::vector<std::array<std::uint32_t, 3>> triangles;
  std::array<std::vector<std::uint32_t>, 4> sides;  ///< west, south, east, north
  std::vector<std::array<double, 3>> normals;
  nlohmann::json metadata;
  int index_bytes;

  [[nodiscard]] double HeightM(std::uint32_t vertex) const {
    return heights_m[0] + (double{heights_m[1]} - heights_m[0]) * vertices[vertex][2] / 32767;
  }
  /// Of the tile x, y at `zoom`, of two columns and a row at zoom 0, y from the south.
  [[nodiscard]] Geodetic Place(std::uint32_t vertex, int zoom, std::int64_t x,
                               std::int64_t y) const {
    const double side = std::ldexp(180, -zoom);
    return {-180 + side * (static_cast<double>(x) + vertices[vertex][0] / 32767.0),
            -90 + side * (static_cast<double>(y) + vertices[vertex][1] / 32767.0), HeightM(vertex)};
  }
};

/// Reads a tile; throws std::runtime_error where it ends early, says something else than the
/// specification has, or has bytes left.
inline TerrainTile ReadTerrainTile(const std::string& bytes) {
  std::size_t at = 0;
  const auto read = [&]<typename Number>(Number) {
    Number value;
    if (at + sizeof(Number) > bytes.size()) throw std::runtime_error("the tile ends early");
    std::memcpy(&value, bytes.data() + at, sizeof(Number));
    at += sizeof(Number);
    return value;
  };
  const auto point = [&]() -> Ecef {
    const double x = read(0.0);
    const double y = read(0.0);
    return {x, y, read(0.0)};
  };
  TerrainTile tile{};
  tile.centre = point();
  tile.heights_m[0] = read(0.0F);
  tile.heights_m[1] = read(0.0F);
  tile.sphere = point();
  tile.sphere_m = read(0.0);
  tile.occlusion = point();
  tile.vertices.resize(read(std::uint32_t{}));
  for (std::size_t k = 0; k < 3; ++k) {
    int value = 0;
    for (auto& vertex : tile.vertices) {
      const unsigned code = read(std::uint16_t{});
      value += static_cast<int>(code >> 1U) ^ -static_cast<int>(code & 1U);
      if (value < 0 || value > 32767) throw std::runtime_error("a coordinate is out of range");
      vertex[k] = value;
    }
  }
  tile.index_bytes = tile.vertices.size() > 65536 ? 4 : 2;
  const auto index = [&]() -> std::uint32_t {
    return tile.index_bytes == 4 ? read(std::uint32_t{}) : read(std::uint16_t{});
  };
  while (at % static_cast<std::size_t>(tile.index_bytes) != 0) {
    if (bytes.at(at++) != 0) throw std::runtime_error("padding is not 0");
  }
  tile.triangles.resize(read(std::uint32_t{}));
  std::uint32_t highest = 0;
  for (auto& triangle : tile.triangles) {
    for (std::uint32_t& corner : triangle) {
      const std::uint32_t code = index();
      corner = highest - code;
      if (code == 0) ++highest;
      if (corner >= tile.vertices.size()) throw std::runtime_error("no such vertex");
    }
  }
  if (highest != tile.vertices.size()) throw std::runtime_error("a vertex is in no triangle");
  for (auto& side : tile.sides) {
    side.resize(read(std::uint32_t{}));
    for (std::uint32_t& vertex : side) vertex = index();
  }
  while (at < bytes.size()) {
    const int id = read(std::uint8_t{});
    const std::size_t length = read(std::uint32_t{});
    const std::size_t end = at + length;
    if (id == 1) {
      for (std::size_t i = 0; i < tile.vertices.size(); ++i) {
        const double u = read(std::uint8_t{}) / 255.0 * 2 - 1;
        const double v = read(std::uint8_t{}) / 255.0 * 2 - 1;
        std::array<double, 3> n = {u, v, 1 - std::abs(u) - std::abs(v)};
        if (n[2] < 0) {
          n[0] = (1 - std::abs(v)) * (u < 0 ? -1 : 1);
          n[1] = (1 - std::abs(u)) * (v < 0 ? -1 : 1);
        }
        const double size = std::hypot(n[0], n[1], n[2]);
        tile.normals.push_back({n[0] / size, n[1] / size, n[2] / size});
      }
    } else if (id == 4) {
      const std::size_t text = read(std::uint32_t{});
      tile.metadata = nlohmann::json::parse(bytes.substr(at, text));
      at += text;
    } else {
      throw std::runtime_error("an extension that was not asked for");
    }
    if (at != end) throw std::runtime_error("an extension's length is wrong");
  }
  return tile;
}

}  // namespace farhorizon
