// The topology of the levels. Every operation touches the triangles around one vertex or edge and
// allocates nothing.
#include "core/simplify/mesh/half_edge_mesh.h"

#include <algorithm>
#include <utility>

namespace farhorizon {

bool HalfEdgeMesh::Gather(std::int32_t v, Ring& ring) const {
  ring.centre = v;
  ring.count = 0;
  if (degree_[v] > Ring::kMost) return false;  // knotted ones, too
  std::int32_t h = out_[v];
  do {
    const std::int32_t last = Previous(h);
    ring.triangle[static_cast<std::size_t>(ring.count)] = h / 3;
    const std::int32_t n = origin_[Next(h)];
    ring.Add(n, at_[n]);
    h = twin_[last];
    ring.closed = h != kNone;
    if (!ring.closed) ring.Add(origin_[last], at_[origin_[last]]);
  } while (ring.closed && h != out_[v]);
  return true;
}

std::vector<std::int32_t> HalfEdgeMesh::GatherRim(std::int32_t v) const {
  std::vector<std::int32_t> around;  // half-edges from v
  for (std::int32_t h = out_[v]; h != kNone; h = twin_[Previous(h)]) around.push_back(h);
  return around;
}

void HalfEdgeMesh::ChangeDegree(std::int32_t v, std::int32_t by) {
  if (degree_[v] >= kMany) return;
  degree_[v] = static_cast<std::uint8_t>(std::min<std::int32_t>(degree_[v] + by, kMany));
}

void HalfEdgeMesh::SetTwins(std::int32_t h, std::int32_t other) {
  twin_[h] = other;
  if (other != kNone) twin_[other] = h;
}

// From any half-edge of v to the one that a ring begins with: the rim's, if there is a rim.
void HalfEdgeMesh::SetOut(std::int32_t v, std::int32_t from) {
  std::int32_t h = from;
  while (twin_[h] != kNone) {
    h = Next(twin_[h]);
    if (h == from) break;
  }
  out_[v] = h;
}

std::int32_t HalfEdgeMesh::CornerOf(std::int32_t v, std::int32_t triangle) const {
  std::int32_t h = 3 * triangle;
  while (origin_[h] != v) ++h;
  return h;
}

void HalfEdgeMesh::Collapse(const Ring& ring, std::int32_t b) {
  std::array<std::int32_t, 4> seam = {};
  std::size_t seams = 0;
  for (std::int32_t i = 0; i < ring.sides(); ++i) {
    const std::int32_t t = ring.triangle_at(i);
    const std::int32_t h = CornerOf(ring.centre, t);
    const std::int32_t p = origin_[Next(h)];
    const std::int32_t q = origin_[Previous(h)];
    if (p != b && q != b) {
      origin_[h] = b;
      continue;
    }
    const std::int32_t outer = twin_[Next(h)];
    const std::int32_t inner = p == b ? twin_[Previous(h)] : twin_[h];
    if (outer != kNone) {
      twin_[outer] = inner;
      seam[seams++] = outer;
    }
    if (inner != kNone) {
      twin_[inner] = outer;
      seam[seams++] = inner;
    }
    ChangeDegree(p == b ? q : p, -1);
    origin_[3 * t] = ~origin_[3 * t];
    --triangles_;
  }
  // The rim goes on from b where it went on from the centre.
  if (!ring.closed && b == ring.id(ring.count - 1)) out_[b] = out_[ring.centre];
  out_[ring.centre] = kNone;
  for (std::size_t i = 0; i < seams; ++i) {
    const std::int32_t u = origin_[seam[i]];
    if (twin_[seam[i]] == kNone || !Stands(out_[u] / 3)) out_[u] = seam[i];
  }
  ChangeDegree(b, ring.count - (ring.closed ? 4 : 3));
}

void HalfEdgeMesh::TakeBack(std::int32_t v, std::int32_t b, std::int32_t gone) {
  // A triangle that is gone keeps its corners, and knows its twins. What has become of the triangle
  // beyond it does not matter: the seam's inner side knows its twin of today.
  std::array<std::int32_t, 2> revived = {};
  std::size_t count = 0;
  for (std::int32_t t = gone; t != kNone;) {
    origin_[3 * t] = ~origin_[3 * t];
    ++triangles_;
    const std::int32_t h = CornerOf(v, t);
    revived[count++] = h;
    const std::int32_t across = origin_[Next(h)] == b ? twin_[h] : twin_[Previous(h)];
    t = count < 2 && across != kNone ? across / 3 : kNone;
  }
  for (std::size_t i = 0; i < count; ++i) {
    const std::int32_t h = revived[i];
    const bool to_b = origin_[Next(h)] == b;
    const std::int32_t spoke = to_b ? Previous(h) : h;
    const std::int32_t inner = twin_[spoke];
    SetTwins(Next(h), twin_[inner]);
    twin_[inner] = spoke;
    ChangeDegree(to_b ? origin_[Previous(h)] : origin_[Next(h)], 1);
  }
  SetOut(v, revived[0]);
  std::int32_t triangles = 0;
  std::int32_t g = out_[v];
  do {
    origin_[g] = v;
    ++triangles;
    g = twin_[Previous(g)];
  } while (g != kNone && g != out_[v]);
  ChangeDegree(b, g == kNone ? 2 - triangles : 4 - triangles);
  for (std::size_t i = 0; i < count; ++i) {
    for (const std::int32_t h : {Next(revived[i]), Previous(revived[i])}) {
      out_[origin_[h]] = h;
      if (!IsKnotted(origin_[h])) SetOut(origin_[h], h);
    }
  }
}

void HalfEdgeMesh::Flip(std::int32_t h) {
  const std::int32_t o = twin_[h];
  const std::int32_t a = origin_[h];
  const std::int32_t c = origin_[Next(h)];
  const std::int32_t b = origin_[Previous(h)];
  const std::int32_t d = origin_[Previous(o)];
  const std::int32_t cb = twin_[Next(h)];
  const std::int32_t ba = twin_[Previous(h)];
  const std::int32_t ad = twin_[Next(o)];
  const std::int32_t dc = twin_[Previous(o)];
  const std::int32_t t = h - h % 3;
  const std::int32_t u = o - o % 3;
  const std::array<std::int32_t, 3> upper = {d, c, b};
  const std::array<std::int32_t, 3> lower = {d, b, a};
  for (std::int32_t k = 0; k < 3; ++k) {
    origin_[t + k] = upper[static_cast<std::size_t>(k)];
    origin_[u + k] = lower[static_cast<std::size_t>(k)];
  }
  SetTwins(t, dc);
  SetTwins(t + 1, cb);
  SetTwins(t + 2, u);
  SetTwins(u + 1, ba);
  SetTwins(u + 2, ad);
  for (const auto& [v, from] :
       {std::pair{a, u + 2}, std::pair{b, t + 2}, std::pair{c, t + 1}, std::pair{d, t}}) {
    if (!IsKnotted(v)) SetOut(v, from);
  }
  ChangeDegree(a, -1);
  ChangeDegree(c, -1);
  ChangeDegree(b, 1);
  ChangeDegree(d, 1);
}

void HalfEdgeMesh::Measure(std::int32_t triangle) {
  if (!Stands(triangle)) return;
  const std::int32_t h = 3 * triangle;
  squares_[triangle] = measure_.Of(at_[origin_[h]], at_[origin_[h + 1]], at_[origin_[h + 2]]);
}

void HalfEdgeMesh::MeasureAll() {
  for (std::int32_t t = 0; t < half_edges() / 3; ++t) Measure(t);
}

void HalfEdgeMesh::Compact() {
  Table<std::int32_t> moved(half_edges() / 3, kNone);
  std::int32_t count = 0;
  for (std::int32_t t = 0; t < moved.size(); ++t) {
    if (Stands(t)) moved[t] = count++;
  }
  const auto place = [&](std::int32_t h) { return h == kNone ? kNone : 3 * moved[h / 3] + h % 3; };
  for (std::int32_t t = 0; t < moved.size(); ++t) {
    if (moved[t] == kNone) continue;
    for (std::int32_t k = 0; k < 3; ++k) {
      origin_[3 * moved[t] + k] = origin_[3 * t + k];
      twin_[3 * moved[t] + k] = place(twin_[3 * t + k]);
    }
    squares_[moved[t]] = squares_[t];
  }
  for (std::int32_t v = 0; v < vertices(); ++v) {
    if (!IsKnotted(v)) out_[v] = place(out_[v]);
  }
  // A knot's half-edge may have gone with its triangle: any of the others will do.
  for (std::int32_t h = 0; h < 3 * count; ++h) {
    if (IsKnotted(origin_[h])) out_[origin_[h]] = h;
  }
  origin_.resize(3 * count);
  twin_.resize(3 * count);
  squares_.resize(count);
  origin_.shrink_to_fit();
  twin_.shrink_to_fit();
  squares_.shrink_to_fit();
}

}  // namespace farhorizon
