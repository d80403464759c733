// libFuzzer's target: the engines against each other, the kinetic one's invariants and, on tiny
// grids, the definition. An offence is shrunk, drawn and ends the run; libFuzzer keeps the bytes.
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <iostream>

#include "tests/fuzz/dem_from_bytes.h"
#include "tests/support/engine_agreement.h"

namespace {

constexpr std::int64_t kMostPostsChecked = 36;  // larger ones would take most of the time

// Tangents and hulls are kept in a way that the first height tells, so that all are tried.
farhorizon::KineticOptions OptionsFor(const farhorizon::Terrain& terrain) {
  const auto way = static_cast<std::uint32_t>(terrain.dem().heights.front()) % 4;
  return {.tangents = way % 2 == 0 ? farhorizon::KineticTangents::kNeighbours
                                   : farhorizon::KineticTangents::kAllPairs,
          .hull = way / 2 == 0 ? farhorizon::HullCertificates::kTurns
                               : farhorizon::HullCertificates::kTree};
}

farhorizon::Result<farhorizon::KineticHorizon> Kinetic(const farhorizon::Terrain& terrain) {
  const farhorizon::KineticOptions options = OptionsFor(terrain);
  return terrain.post_count() <= kMostPostsChecked
             ? farhorizon::FindHorizonKineticChecked(terrain, options)
             : farhorizon::FindHorizonKinetic(terrain, {}, options);
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const farhorizon::Engines engines{.kinetic = Kinetic, .posts_by_definition = 16};
  const farhorizon::Dem dem = farhorizon::DemFromBytes({data, size});
  if (farhorizon::EngineOffence(dem, engines).empty()) return 0;
  std::cerr << farhorizon::SmallestOffence(dem, engines) << std::endl;
  std::abort();
}
