#pragma once

#include <vector>

#include "core/simplify/order/collapser.h"
#include "core/simplify/sides/side_posts.h"
#include "core/simplify/work/workpiece.h"

namespace farhorizon {

/// Brings the mesh's sides to the posts and heights that SidePosts says, whatever it costs.
class SideThinner {
 public:
  /// Requires: both outlive it.
  SideThinner(Workpiece& work, Collapser& collapser) : work_(&work), collapser_(&collapser) {}

  /// Collapses what goes along the side and gives what stays its height; the rest of a side's
  /// vertices is held (Workpiece::stays). A vertex whose ring would turn over is left for Finish.
  void Thin(const std::vector<SidePosts::Height>& staying);
  /// Takes away what is left to go: by collapse, now that its ring has changed, or by cutting it
  /// off. Afterwards there is none but knotted ones, whose fans are two outlines' corners.
  void Finish(const std::vector<SidePosts::Height>& staying);

 private:
  void Mark(const std::vector<SidePosts::Height>& staying);
  void Collapse();
  void CutOff(std::int32_t v);

  Workpiece* work_;
  Collapser* collapser_;
  std::vector<std::int32_t> going_;  // vertices, rising
};

}  // namespace farhorizon
