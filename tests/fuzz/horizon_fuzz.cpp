// libFuzzer's target: the engines against each other and, on tiny grids, against the definition.
// An offence is shrunk, drawn and ends the run; libFuzzer keeps the bytes.
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <iostream>

#include "tests/fuzz/dem_from_bytes.h"
#include "tests/support/engine_agreement.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const farhorizon::Engines engines{.posts_by_definition = 16};
  const farhorizon::Dem dem = farhorizon::DemFromBytes({data, size});
  if (farhorizon::EngineOffence(dem, engines).empty()) return 0;
  std::cerr << farhorizon::SmallestOffence(dem, engines) << std::endl;
  std::abort();
}
