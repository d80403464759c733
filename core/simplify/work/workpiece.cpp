#include "core/simplify/work/workpiece.h"

namespace farhorizon {

void Workpiece::Put(const Ring& ring, const Place& place) {
  mesh.SetPlace(ring.centre, place);
  for (std::int32_t i = 0; i < ring.sides(); ++i) mesh.Measure(ring.triangle_at(i));
  for (std::int32_t i = 0; i < ring.count; ++i) Touch(ring.id(i), 0);
  Touch(ring.centre, 0);
  price.RestoreLost(ring, ring.centre, -1);
  for (std::int32_t i = 0; i < ring.count; ++i) {
    if (price.MayRise(place, ring.at(i))) skyline.Raise(ring.centre, ring.id(i));
  }
}

}  // namespace farhorizon
