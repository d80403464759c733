#pragma once

#include "core/horizon/find_horizon.h"
#include "core/simplify/work/workpiece.h"

namespace farhorizon {

/// A terrain with all that simplifying works on.
struct Workbench {
  explicit Workbench(const Dem& of, const EarthDrop& drop = {}, std::int32_t directions = 32)
      : dem(of),
        terrain(*Terrain::Build(dem)),
        horizon(*FindHorizon(terrain, {}, {})),
        ground(terrain, drop),
        work(ground, horizon, directions) {}

  Dem dem;
  Terrain terrain;
  Horizon horizon;
  Ground ground;
  Workpiece work;
};

}  // namespace farhorizon
