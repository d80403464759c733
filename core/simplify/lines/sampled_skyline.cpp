// A line keeps its five highest crossings and no others, so that its upkeep is some comparisons.
// What it does not know makes a loss look greater than it is, and never smaller. A vertex' list of
// lines may have some that it carries no more: who reads one asks Carries.
#include "core/simplify/lines/sampled_skyline.h"

#include <algorithm>

namespace farhorizon {

namespace {

bool IsEdge(const SampledSkyline::Crossing& c, std::int32_t a, std::int32_t b) {
  return (c.a == a && c.b == b) || (c.a == b && c.b == a);
}

}  // namespace

SampledSkyline::SampledSkyline(const HalfEdgeMesh& mesh, const Horizon& horizon,
                               std::int32_t directions)
    : mesh_(&mesh),
      pencils_(mesh.ground().columns(), mesh.ground().rows(), directions),
      dem_(pencils_.lines(), kNone),
      top_(pencils_.lines(), kNone),
      crossings_(static_cast<std::size_t>(pencils_.lines()) * kKept),
      count_(pencils_.lines(), 0),
      known_(static_cast<std::size_t>(mesh.vertices()), false),
      carried_(mesh.vertices()) {
  for (const HorizonEdge& h : horizon.edges) {
    const Edge& e = h.edge;
    pencils_.ForEachLineAcross(mesh.at(e.a), mesh.at(e.b), [&](std::int32_t line, float height) {
      Keep(line, {height, e.a, e.b});
    });
  }
  for (std::int32_t line = 0; line < pencils_.lines(); ++line) {
    if (count_[line] == 0) continue;
    dem_[line] = Best(line).height;
    Crown(line);
  }
  CountLines();
}

void SampledSkyline::CountLines() {
  lines_ = 0;
  for (std::int32_t line = 0; line < pencils_.lines(); ++line) lines_ += Counts(line) ? 1 : 0;
  posts_per_line_ = static_cast<double>(mesh_->vertices()) /
                    static_cast<double>(std::max<std::int64_t>(lines_, 1));
}

void SampledSkyline::Thin(std::int64_t least) {
  while (lines_ / 2 >= least) {
    pencils_.Halve();
    CountLines();
  }
}

float SampledSkyline::HeightOn(std::int32_t line, std::int32_t a, std::int32_t b) const {
  if (!mesh_->IsVertex(a) || !mesh_->IsVertex(b)) return kNone;
  const float s = pencils_.Distance(line, mesh_->at(a));
  const float t = pencils_.Distance(line, mesh_->at(b));
  return Crosses(s, t) ? HeightBetween(mesh_->at(a), mesh_->at(b), s, t) : kNone;
}

float SampledSkyline::Without(std::int32_t line, std::int32_t v) const {
  const Crossing* c = &Best(line);
  for (std::uint8_t i = 1; i < count_[line]; ++i) {
    const float z = c[i].a == v || c[i].b == v ? kNone : HeightOn(line, c[i].a, c[i].b);
    if (z > kNone) return z;
  }
  return kNone;
}

bool SampledSkyline::Keep(std::int32_t line, const Crossing& crossing) {
  Crossing* c = &crossings_[static_cast<std::size_t>(line) * kKept];
  std::size_t n = count_[line];
  if (n == kKept && crossing.height <= c[n - 1].height) return false;
  for (std::size_t i = 0; i < n; ++i) {
    if (IsEdge(c[i], crossing.a, crossing.b)) return false;
  }
  std::size_t i = n < kKept ? n++ : kKept - 1;
  for (; i > 0 && c[i - 1].height < crossing.height; --i) c[i] = c[i - 1];
  c[i] = crossing;
  count_[line] = static_cast<std::uint8_t>(n);
  known_[static_cast<std::size_t>(crossing.a)] = true;
  known_[static_cast<std::size_t>(crossing.b)] = true;
  return true;
}

void SampledSkyline::Refresh(std::int32_t line, std::int32_t a, std::int32_t b) {
  std::array<Crossing, kKept> old;
  const std::size_t n = count_[line];
  std::copy_n(&Best(line), n, old.begin());
  count_[line] = 0;
  for (std::size_t i = 0; i < n; ++i) {
    const Crossing& c = old[i];
    const float z = IsEdge(c, a, b) ? kNone : HeightOn(line, c.a, c.b);
    if (z > kNone) Keep(line, {z, c.a, c.b});
  }
}

bool SampledSkyline::KeepEdge(std::int32_t line, std::int32_t a, std::int32_t b) {
  const float z = HeightOn(line, a, b);
  return z > kNone && Keep(line, {z, a, b});
}

void SampledSkyline::Forget(std::int32_t a, std::int32_t b) {
  if (!known_[static_cast<std::size_t>(a)] || !known_[static_cast<std::size_t>(b)]) return;
  pencils_.ForEachLineAcross(mesh_->at(a), mesh_->at(b), [&](std::int32_t line, float) {
    const Crossing best = Best(line);
    Refresh(line, a, b);
    // The new best must be listed as a carrier, or the line's top would outlive it.
    if (!IsEdge(Best(line), best.a, best.b)) Crown(line);
  });
}

void SampledSkyline::Crown(std::int32_t line) {
  if (count_[line] == 0) return;
  top_[line] = Best(line).height;
  carried_.Add(Best(line).a, line);
  carried_.Add(Best(line).b, line);
}

void SampledSkyline::Raise(std::int32_t a, std::int32_t b) {
  pencils_.ForEachLineAcross(mesh_->at(a), mesh_->at(b), [&](std::int32_t line, float height) {
    if (height > top_[line] && Meets(line) && Keep(line, {height, a, b})) Crown(line);
  });
}

}  // namespace farhorizon
