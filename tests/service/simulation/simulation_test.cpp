// The job engine on a virtual clock with virtual clients and workers. SIMULATION_SEED=N repeats one
// seed, SIMULATION_SEEDS=N takes as many from 0.
#include "tests/service/simulation/simulation.h"

#include <cstdlib>
#include <unistd.h>

#include <gtest/gtest.h>

#include "tests/support/effort.h"

namespace farhorizon {
namespace {

constexpr int kSteps = 120;

int NumberOf(const char* variable, int otherwise) {
  const char* value = std::getenv(variable);
  return value == nullptr ? otherwise : std::atoi(value);
}

TEST(Simulation, KeepsTheInvariantsAfterEveryStep) {
  // Nothing here is to outlive a power cut: in memory, a sync costs nothing.
  if (access("/dev/shm", W_OK) == 0) setenv("TMPDIR", "/dev/shm", 0);
  const int one = NumberOf("SIMULATION_SEED", -1);
  const int first = one >= 0 ? one : 0;
  const int end = one >= 0 ? one + 1 : NumberOf("SIMULATION_SEEDS", Rounds(100));
  for (int seed = first; seed < end; ++seed) {
    const std::string broken = Simulation(static_cast<std::uint32_t>(seed)).Run(kSteps);
    ASSERT_TRUE(broken.empty()) << "SIMULATION_SEED=" << seed << ", " << broken;
  }
}

}  // namespace
}  // namespace farhorizon
