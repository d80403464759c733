#include "tests/support/engines_agree.h"

#include <algorithm>
#include <exception>
#include <fstream>
#include <string>

#include "core/horizon/trace/sweep_trace.h"
#include "core/io/sweep_svg.h"

namespace farhorizon {
namespace {

/// The name of a picture of the sweep, or why there is none: the sweep may be what is broken.
std::string Picture(const Dem& dem) {
  static int count = 0;
  try {
    const Terrain terrain = *Terrain::Build(dem);
    std::int32_t least = (1 << 30) - 1;
    std::int32_t most = -least;
    for (const std::int32_t h : dem.heights) {
      if (h == kNoHeight) continue;
      least = std::min(least, h);
      most = std::max(most, h);
    }
    const auto middle = static_cast<std::int32_t>((std::int64_t{least} + most + 1) / 2);
    Result<SweepTrace> trace = TraceSweep(terrain, middle, {});
    if (!trace) return "none: " + trace.error().message;
    const std::string path = testing::TempDir() + "sweep-" + std::to_string(++count) + ".svg";
    std::ofstream(path) << DrawSweep(*trace, "the sweep at height " + std::to_string(middle));
    return path;
  } catch (const std::exception& broken) {
    return std::string("none, it throws: ") + broken.what();
  }
}

}  // namespace

testing::AssertionResult EnginesAgree(const Dem& dem, const Engines& engines) {
  if (EngineOffence(dem, engines).empty()) return testing::AssertionSuccess();
  const Dem small = SmallestOffender(dem, engines);
  return testing::AssertionFailure()
         << SmallestOffence(small, engines) << "picture: " << Picture(small);
}

}  // namespace farhorizon
