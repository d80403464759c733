#include "core/horizon/visibility/moving_vector.h"

namespace farhorizon {

Quadratic Cross(const MovingVector& a, const MovingVector& b) {
  return {Int128{a.ax} * b.ay - Int128{a.ay} * b.ax,
          Int128{a.ax} * b.by - Int128{a.ay} * b.bx + Int128{a.bx} * b.ay - Int128{a.by} * b.ax,
          Int128{a.bx} * b.by - Int128{a.by} * b.bx};
}

Quadratic Dot(const MovingVector& a, const MovingVector& b) {
  return {Int128{a.ax} * b.ax + Int128{a.ay} * b.ay,
          Int128{a.ax} * b.bx + Int128{a.ay} * b.by + Int128{a.bx} * b.ax + Int128{a.by} * b.ay,
          Int128{a.bx} * b.bx + Int128{a.by} * b.by};
}

}  // namespace farhorizon
