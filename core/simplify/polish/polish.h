#pragma once

#include "core/base/result.h"
#include "core/simplify/work/workpiece.h"

namespace farhorizon {

/// What makes a level better at the number of triangles that it has, each in the order of half-edge
/// or vertex numbers, once. Errors: kCancelled.

/// Turns edges to the other diagonal of their two triangles where that lowers the sum.
Status FlipEdges(Workpiece& work, const RunControl& control);
/// Moves vertices inside the mesh to better posts: of those around, first two steps away, then one,
/// so by three posts at most along each axis.
Status MoveVertices(Workpiece& work, const RunControl& control);
/// Gives vertices inside the mesh and at the rims of holes the heights at which the sum is least,
/// their neighbours' heights given.
Status FitHeights(Workpiece& work, const RunControl& control);

}  // namespace farhorizon
