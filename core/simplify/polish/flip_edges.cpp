#include <algorithm>

#include "core/simplify/mesh/squares.h"
#include "core/simplify/polish/least_gain.h"
#include "core/simplify/polish/polish.h"

namespace farhorizon {

namespace {

class Flipper {
 public:
  explicit Flipper(Workpiece& work) : work_(work), mesh_(work.mesh) {
    // The most that lines carried at a vertex could win back bounds what its edges' could.
    for (std::int32_t v = 0; v < mesh_.vertices(); ++v) {
      most_.push_back(mesh_.IsVertex(v) ? work.price.Begin(v) : 0);
    }
  }

  // Flips the edge of h where that lowers the sum. Requires: it has a twin.
  void Consider(std::int32_t h) {
    const std::int32_t o = mesh_.twin(h);
    const std::int32_t a = mesh_.origin(h);
    const std::int32_t c = mesh_.origin(HalfEdgeMesh::Next(h));
    const std::int32_t b = mesh_.origin(HalfEdgeMesh::Previous(h));
    const std::int32_t d = mesh_.origin(HalfEdgeMesh::Previous(o));
    const Place& pa = mesh_.at(a);
    const Place& pb = mesh_.at(b);
    const Place& pc = mesh_.at(c);
    const Place& pd = mesh_.at(d);
    if (Turn(pd, pc, pb) <= 0 || Turn(pd, pb, pa) <= 0 || work_.rules.MustStay(pa, pc)) return;
    const float most_m = work_.rules.most_m();
    const float slack = std::min(most_[a], most_[c]);
    float change = Squares(work_.ground, pd, pc, pb, most_m) +
                   Squares(work_.ground, pd, pb, pa, most_m) - mesh_.squares(h / 3) -
                   mesh_.squares(o / 3);
    if (change - slack >= -kLeastGain) return;
    quad_.count = 0;
    quad_.closed = true;
    for (const std::int32_t v : {a, d, c, b}) quad_.Add(v, mesh_.at(v));
    if (change - work_.price.BeginFlip(quad_) >= -kLeastGain) return;
    change += work_.price.ChangeOfFlip(quad_);
    change += work_.price.RiseOf(pb, pd);
    if (change >= -kLeastGain || !work_.rules.Allows(pb, pd)) return;
    mesh_.Flip(h);
    mesh_.Measure(h / 3);
    mesh_.Measure(o / 3);
    for (const std::int32_t v : {a, b, c, d}) work_.Touch(v, 0);
    work_.skyline.Forget(a, c);
    work_.skyline.Raise(b, d);
    work_.price.RestoreFlipped(quad_);
  }

 private:
  Workpiece& work_;
  HalfEdgeMesh& mesh_;
  Table<float> most_;  // per vertex
  Ring quad_;
};

}  // namespace

Status FlipEdges(Workpiece& work, const RunControl& control) {
  Flipper flipper(work);
  for (std::int32_t h = 0; h < work.mesh.half_edges(); ++h) {
    if (h % kVerticesBetweenChecks == 0 && control.StopRequested()) {
      return Error{ErrorCode::kCancelled, "stopped while simplifying"};
    }
    if (work.mesh.twin(h) > h && work.mesh.Stands(h / 3)) flipper.Consider(h);
  }
  return Ok{};
}

}  // namespace farhorizon
