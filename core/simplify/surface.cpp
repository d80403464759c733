#include "core/simplify/surface.h"

namespace farhorizon {

Surface::Surface(const Terrain& terrain)
    : first_corner_(static_cast<std::size_t>(terrain.post_count()), kNone) {
  const std::vector<Triangle> triangles = terrain.Triangles();
  triangle_count_ = static_cast<std::int64_t>(triangles.size());
  corners_.reserve(triangles.size() * 3);
  for (const Triangle& t : triangles) corners_.insert(corners_.end(), t.begin(), t.end());
  next_corner_.resize(corners_.size());
  for (std::size_t c = corners_.size(); c-- > 0;) Chain(corners_[c], static_cast<Corner>(c));
}

std::int32_t Surface::CountTrianglesOf(VertexId v) const {
  std::int32_t count = 0;
  for (Corner c = first_corner_[Index(v)]; c != kNone; c = next_corner_[Index(c)]) ++count;
  return count;
}

void Surface::Chain(VertexId v, Corner c) {
  next_corner_[Index(c)] = first_corner_[Index(v)];
  first_corner_[Index(v)] = c;
}

void Surface::Unchain(VertexId v, Corner c) {
  Corner* link = &first_corner_[Index(v)];
  while (*link != c) link = &next_corner_[Index(*link)];
  *link = next_corner_[Index(c)];
}

void Surface::Collapse(VertexId v, VertexId b) {
  Corner c = first_corner_[Index(v)];
  first_corner_[Index(v)] = kNone;
  while (c != kNone) {
    const Corner next = next_corner_[Index(c)];
    const TriangleId t = c / 3;
    const Corner second = 3 * t + (c + 1) % 3;
    const Corner third = 3 * t + (c + 2) % 3;
    const VertexId w = corners_[Index(second)];
    const VertexId x = corners_[Index(third)];
    if (w == b || x == b) {
      Unchain(w, second);
      Unchain(x, third);
      corners_[Index(3 * t)] = kNone;
      --triangle_count_;
    } else {
      corners_[Index(c)] = b;
      Chain(b, c);
    }
    c = next;
  }
}

std::vector<Triangle> Surface::Triangles() const {
  std::vector<Triangle> triangles;
  triangles.reserve(static_cast<std::size_t>(triangle_count_));
  for (TriangleId t = 0; t < triangle_id_end(); ++t) {
    if (At(t, 0) != kNone) triangles.push_back(triangle(t));
  }
  return triangles;
}

}  // namespace farhorizon
