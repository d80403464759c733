// The job engine on a virtual clock with virtual clients and workers. SIMULATION_SEEDS=27 repeats
// one seed, SIMULATION_SEEDS=1-100000 takes as many.
#include "tests/service/simulation/simulation.h"

#include <cstdlib>
#include <filesystem>
#include <iostream>
#include <string>
#include <unistd.h>

#include <gtest/gtest.h>

#include "tests/support/effort.h"

namespace farhorizon {
namespace {

constexpr int kSteps = 120;

struct Range {
  unsigned long first;
  unsigned long last;
};

Range Seeds() {
  const char* asked = std::getenv("SIMULATION_SEEDS");
  if (asked == nullptr) return {1, static_cast<unsigned long>(Rounds(100))};
  char* end = nullptr;
  const unsigned long first = std::strtoul(asked, &end, 10);
  return {first, *end == '-' ? std::strtoul(end + 1, nullptr, 10) : first};
}

TEST(Simulation, KeepsTheInvariantsAfterEveryStep) {
  // Nothing here is to outlive a power cut: in memory, a sync costs nothing.
  const bool in_memory = ::access("/dev/shm", W_OK) == 0;
  const std::filesystem::path below =
      in_memory ? "/dev/shm" : std::filesystem::temp_directory_path();
  const Range seeds = Seeds();
  for (unsigned long seed = seeds.first; seed <= seeds.last; ++seed) {
    const std::string broken = Simulation(static_cast<std::uint32_t>(seed), below).Run(kSteps);
    ASSERT_EQ(broken, "") << "SIMULATION_SEEDS=" << seed << " shows it";
    if (seed % 1000 == 0) std::cout << seed << " seeds hold" << std::endl;
  }
}

}  // namespace
}  // namespace farhorizon
