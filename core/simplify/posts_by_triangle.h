#pragma once

#include <cstdint>
#include <vector>

#include "core/simplify/surface.h"
#include "core/terrain/terrain.h"

namespace farhorizon {

/// For each triangle of a surface, the posts under it that are no vertices any more, as linked
/// lists.
///
/// Each such post is in one list. A post on an edge is in that of either triangle beside the edge:
/// their heights agree there. Memory: 4 bytes a post, 12 a triangle.
class PostsByTriangle {
 public:
  PostsByTriangle(VertexId posts, TriangleId triangles)
      : first_post_(static_cast<std::size_t>(triangles), kNone),
        squares_(static_cast<std::size_t>(triangles), 0.0),
        next_post_(static_cast<std::size_t>(posts), kNone) {}

  template <typename Visit>
  void ForEachPostUnder(TriangleId t, Visit visit) const {
    for (VertexId p = first_post_[static_cast<std::size_t>(t)]; p != kNone;
         p = next_post_[static_cast<std::size_t>(p)]) {
      visit(p);
    }
  }
  /// Sum of the squared vertical errors at the posts under `t`, quanta squared.
  [[nodiscard]] double squares(TriangleId t) const { return squares_[static_cast<std::size_t>(t)]; }

  void Clear(TriangleId t) {
    first_post_[static_cast<std::size_t>(t)] = kNone;
    squares_[static_cast<std::size_t>(t)] = 0;
  }
  void Add(TriangleId t, VertexId post, double error) {
    next_post_[static_cast<std::size_t>(post)] = first_post_[static_cast<std::size_t>(t)];
    first_post_[static_cast<std::size_t>(t)] = post;
    squares_[static_cast<std::size_t>(t)] += error * error;
  }

 private:
  static constexpr VertexId kNone = -1;
  std::vector<VertexId> first_post_;  // per triangle
  std::vector<double> squares_;       // per triangle
  std::vector<VertexId> next_post_;   // per post
};

}  // namespace farhorizon
