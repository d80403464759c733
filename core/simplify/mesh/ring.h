#pragma once

#include <array>
#include <cstdint>
#include <cstdlib>

#include "core/simplify/mesh/place.h"

namespace farhorizon {

/// What is around a vertex: its neighbours in turning order, and its triangles.
///
/// Triangle i has the corners (centre, posts i, posts after(i)). A closed ring goes all the way
/// round; an open one, at the rim, has one triangle less than neighbours.
struct Ring {
  static constexpr std::int32_t kMost = 64;  ///< neighbours; a vertex with more is left alone

  std::int32_t centre = 0;
  std::int32_t count = 0;  ///< neighbours
  bool closed = false;
  std::array<std::int32_t, kMost> neighbour = {};
  std::array<std::int32_t, kMost> triangle = {};
  std::array<Place, kMost> place = {};  ///< of the neighbours

  [[nodiscard]] std::int32_t sides() const { return closed ? count : count - 1; }
  [[nodiscard]] std::int32_t after(std::int32_t i) const { return i + 1 == count ? 0 : i + 1; }
  [[nodiscard]] const Place& at(std::int32_t i) const { return place[static_cast<std::size_t>(i)]; }
  [[nodiscard]] std::int32_t id(std::int32_t i) const {
    return neighbour[static_cast<std::size_t>(i)];
  }
  [[nodiscard]] std::int32_t triangle_at(std::int32_t i) const {
    return triangle[static_cast<std::size_t>(i)];
  }
  /// Whether i and j are one or joined by a side of the ring.
  [[nodiscard]] bool Joined(std::int32_t i, std::int32_t j) const {
    const std::int32_t apart = std::abs(i - j);
    return apart <= 1 || (closed && apart == count - 1);
  }
  void Add(std::int32_t vertex, const Place& where) {
    neighbour[static_cast<std::size_t>(count)] = vertex;
    place[static_cast<std::size_t>(count)] = where;
    ++count;
  }
};

}  // namespace farhorizon
