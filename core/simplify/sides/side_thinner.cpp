// What is to go is collapsed along its side, and again as long as one that goes frees the ring of
// another. A vertex that is left then lies straight between its neighbours, but for corners that
// two outlines make, and is cut off. Both keep the sampled skyline up to date.
#include "core/simplify/sides/side_thinner.h"

#include <algorithm>

namespace farhorizon {

void SideThinner::Mark(const std::vector<SidePosts::Height>& staying) {
  const HalfEdgeMesh& mesh = work_->mesh;
  std::vector<bool> stays(static_cast<std::size_t>(mesh.vertices()), false);
  for (const SidePosts::Height& side : staying) stays[static_cast<std::size_t>(side.post)] = true;
  going_.clear();
  for (std::int32_t v = 0; v < mesh.vertices(); ++v) {
    const auto at = static_cast<std::size_t>(v);
    work_->stays[at] = mesh.IsVertex(v) && !work_->IsFree(v);
    if (!mesh.IsVertex(v) || !work_->ground.OnSide(mesh.at(v))) continue;
    // A vertex of a side never moves, so its id is its post.
    work_->stays[at] = true;
    if (!stays[at] && work_->IsFree(v)) going_.push_back(v);
  }
}

void SideThinner::Collapse() {
  for (bool some = true; some;) {
    some = false;
    for (std::int32_t& v : going_) some |= collapser_->Force(v);
    std::erase_if(going_, [this](std::int32_t v) { return !work_->mesh.IsVertex(v); });
  }
}

void SideThinner::Thin(const std::vector<SidePosts::Height>& staying) {
  Mark(staying);
  Collapse();
  Ring ring;
  for (const SidePosts::Height& side : staying) {
    const VertexId v = side.post;
    if (!work_->mesh.IsVertex(v) || !work_->mesh.Gather(v, ring)) continue;
    const Place& from = work_->mesh.at(v);
    const auto plan = static_cast<float>(side.height_m - work_->ground.base_m());
    if (plan == from.plan) continue;
    work_->price.Begin(v);
    work_->price.FindLost(ring);
    work_->Put(ring, work_->ground.WithHeight(from.x, from.y, plan));
  }
}

void SideThinner::Finish(const std::vector<SidePosts::Height>& staying) {
  Mark(staying);
  Collapse();
  for (const std::int32_t v : going_) CutOff(v);
}

void SideThinner::CutOff(std::int32_t v) {
  HalfEdgeMesh& mesh = work_->mesh;
  const std::vector<std::int32_t> spokes = mesh.GatherRim(v);
  const Place& first = mesh.at(mesh.origin(HalfEdgeMesh::Next(spokes.front())));
  const Place& last = mesh.at(mesh.origin(HalfEdgeMesh::Previous(spokes.back())));
  if (Turn(first, mesh.at(v), last) != 0) return;  // a corner that another outline makes
  std::vector<std::int32_t> lines;
  work_->skyline.carried().Take(v, lines);
  mesh.CutOff(v);
  for (const std::int32_t line : lines) {
    // What v carried has the new sides instead, which may all be lower.
    work_->skyline.Refresh(line);
    for (const std::int32_t spoke : spokes) {
      if (!mesh.Stands(spoke / 3)) continue;
      const std::int32_t h = spoke - spoke % 3;
      for (std::int32_t k = h; k < h + 3; ++k) {
        work_->skyline.KeepEdge(line, mesh.origin(k), mesh.origin(HalfEdgeMesh::Next(k)));
      }
    }
    work_->skyline.Crown(line);
  }
  // Each of the triangles filled what one of v's had; their sides are all that is new.
  for (const std::int32_t spoke : spokes) {
    if (!mesh.Stands(spoke / 3)) continue;
    const std::int32_t h = spoke - spoke % 3;
    for (std::int32_t k = h; k < h + 3; ++k) {
      work_->skyline.Raise(mesh.origin(k), mesh.origin(HalfEdgeMesh::Next(k)));
      work_->Touch(mesh.origin(k), 0);
    }
  }
}

}  // namespace farhorizon
