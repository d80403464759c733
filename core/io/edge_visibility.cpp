// Flags edges of a mesh whose vertices may be split: a vertex is named by the least one of the same
// post and position, an edge by two such names, and flagged edges are sorted by name to be found
// from each triangle's sides. O(n log n) for n sides.
#include "core/io/edge_visibility.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>
#include <tuple>

#include "core/base/result.h"

namespace farhorizon {

namespace {

using VertexPair = std::pair<std::uint32_t, std::uint32_t>;

constexpr std::uint8_t kSilhouette = 1;
constexpr std::uint8_t kHard = 2;
constexpr std::uint32_t kNone = std::numeric_limits<std::uint32_t>::max();

// For each vertex the least vertex of the same post and position.
std::vector<std::uint32_t> FirstOfEqual(const LocalMesh& mesh) {
  const auto key = [&](std::uint32_t v) {
    const Enu& p = mesh.positions[v];
    return std::tuple(mesh.posts[v], p.east, p.north, p.up);
  };
  std::vector<std::uint32_t> order(mesh.positions.size());
  std::iota(order.begin(), order.end(), 0U);
  std::ranges::stable_sort(order, [&](auto a, auto b) { return key(a) < key(b); });
  std::vector<std::uint32_t> first(order.size());
  for (std::size_t i = 0; i < order.size(); ++i) {
    const bool same = i > 0 && key(order[i]) == key(order[i - 1]);
    first[order[i]] = same ? first[order[i - 1]] : order[i];
  }
  return first;
}

// A flagged edge and the triangles on both sides; the second is kNone on the border.
struct Flagged {
  VertexPair edge;
  std::array<std::uint32_t, 2> triangles = {kNone, kNone};
};

class FlaggedEdges {
 public:
  FlaggedEdges(const LocalMesh& mesh, const std::vector<VertexPair>& edges)
      : mesh_(mesh), first_(FirstOfEqual(mesh)) {
    for (const auto& [a, b] : edges) {
      Check(a < first_.size() && b < first_.size(), "an edge of vertices that are not there");
      flagged_.push_back({.edge = Name(a, b)});
    }
    std::ranges::sort(flagged_, {}, &Flagged::edge);
    const auto repeated = std::ranges::unique(flagged_, {}, &Flagged::edge);
    flagged_.erase(repeated.begin(), repeated.end());
    for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
      for (std::size_t side = 0; side < 3; ++side) {
        if (Flagged* found = Find(t, side)) {
          found->triangles[found->triangles[0] == kNone ? 0 : 1] = t;
        }
      }
    }
  }

  // The flagged edge at side `side` of triangle t; null where that side is not flagged.
  Flagged* Find(std::uint32_t t, std::size_t side) {
    const auto& triangle = mesh_.triangles[t];
    const VertexPair edge = Name(triangle[side], triangle[(side + 1) % 3]);
    const auto found = std::ranges::lower_bound(flagged_, edge, {}, &Flagged::edge);
    return found != flagged_.end() && found->edge == edge ? &*found : nullptr;
  }

 private:
  [[nodiscard]] VertexPair Name(std::uint32_t a, std::uint32_t b) const {
    return std::minmax(first_[a], first_[b]);
  }

  const LocalMesh& mesh_;
  std::vector<std::uint32_t> first_;
  std::vector<Flagged> flagged_;
};

// The normal of triangle t in signed bytes.
std::array<std::int8_t, 3> NormalOf(const LocalMesh& mesh, std::uint32_t t) {
  const auto& [a, b, c] = mesh.triangles[t];
  const std::array<double, 3> n =
      FaceNormal(mesh.positions[a], mesh.positions[b], mesh.positions[c]);
  const double length = std::sqrt(n[0] * n[0] + n[1] * n[1] + n[2] * n[2]);
  if (length == 0) return {0, 0, 127};
  const auto byte = [&](double x) {
    return static_cast<std::int8_t>(std::lround(127 * x / length));
  };
  return {byte(n[0]), byte(n[1]), byte(n[2])};
}

constexpr std::size_t kNormalBytes = 6;  // of both triangles

std::size_t BytesOf(std::size_t triangles) { return (6 * triangles + 7) / 8; }

// The value of a side, counted through all triangles.
std::uint8_t ValueOf(const EdgeVisibility& edges, std::size_t side) {
  return static_cast<std::uint8_t>(edges.bits[side / 4] >> (2 * (side % 4)) & 3U);
}

void SetValue(EdgeVisibility& edges, std::size_t side, std::uint8_t value) {
  std::uint8_t& bits = edges.bits[side / 4];
  bits = static_cast<std::uint8_t>(bits | (unsigned{value} << (2 * (side % 4))));
}

// Copies `count` triangles from a first side on, and their normals from `normals` on, which is then
// behind the last; false where there are not so many.
bool Copy(const EdgeVisibility& from, std::size_t first_side, std::size_t count,
          std::size_t& normals, EdgeVisibility& to, std::size_t to_side) {
  for (std::size_t i = 0; i < 3 * count; ++i) {
    const std::uint8_t value = ValueOf(from, first_side + i);
    if (value == 0) continue;
    SetValue(to, to_side + i, value);
    ++to.edge_count;
    if (value != kSilhouette) continue;
    if (normals + kNormalBytes > from.normals.size()) return false;
    const auto at = from.normals.begin() + static_cast<std::ptrdiff_t>(normals);
    to.normals.insert(to.normals.end(), at, at + kNormalBytes);
    normals += kNormalBytes;
  }
  return true;
}

}  // namespace

EdgeVisibility FlagEdges(const LocalMesh& mesh, const std::vector<VertexPair>& edges) {
  FlaggedEdges flagged(mesh, edges);
  EdgeVisibility result;
  result.bits.assign(BytesOf(mesh.triangles.size()), 0);
  for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
    for (std::size_t side = 0; side < 3; ++side) {
      const Flagged* found = flagged.Find(t, side);
      if (found == nullptr || found->triangles[0] != t) continue;
      const bool shared = found->triangles[1] != kNone;
      const std::size_t index = 3 * std::size_t{t} + side;
      SetValue(result, index, shared ? kSilhouette : kHard);
      ++result.edge_count;
      if (!shared) continue;
      for (const std::uint32_t neighbour : found->triangles) {
        const std::array<std::int8_t, 3> normal = NormalOf(mesh, neighbour);
        result.normals.insert(result.normals.end(), normal.begin(), normal.end());
      }
    }
  }
  return result;
}

std::vector<EdgeVisibility> SplitEdges(const EdgeVisibility& edges,
                                       const std::vector<std::size_t>& triangles) {
  std::vector<EdgeVisibility> parts;
  std::size_t first = 0;
  std::size_t normals = 0;
  for (const std::size_t count : triangles) {
    EdgeVisibility& part = parts.emplace_back();
    part.bits.assign(BytesOf(count), 0);
    Check(Copy(edges, 3 * first, count, normals, part, 0), "a silhouette edge without normals");
    first += count;
  }
  return parts;
}

std::optional<EdgeVisibility> JoinEdges(const std::vector<EdgeVisibility>& parts,
                                        const std::vector<std::size_t>& triangles) {
  EdgeVisibility joined;
  joined.bits.assign(BytesOf(std::accumulate(triangles.begin(), triangles.end(), std::size_t{0})),
                     0);
  std::size_t first = 0;
  for (std::size_t i = 0; i < parts.size(); ++i) {
    const EdgeVisibility& part = parts[i];
    const std::size_t count = triangles[i];
    // A part in which no edge is flagged has no bits at all.
    if (!part.bits.empty()) {
      std::size_t normals = 0;
      const bool fits = part.bits.size() == BytesOf(count) &&
                        (6 * count % 8 == 0 || part.bits.back() >> (6 * count % 8) == 0);
      if (!fits) return std::nullopt;
      if (!Copy(part, 0, count, normals, joined, 3 * first)) return std::nullopt;
      if (normals != part.normals.size()) return std::nullopt;
    }
    first += count;
  }
  return joined;
}

}  // namespace farhorizon
