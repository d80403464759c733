#include "tests/support/engines_agree.h"

#include "tests/support/engine_agreement.h"

namespace farhorizon {

testing::AssertionResult EnginesAgree(const Dem& dem) {
  const Engines engines;
  if (EngineOffence(dem, engines).empty()) return testing::AssertionSuccess();
  return testing::AssertionFailure() << SmallestOffence(dem, engines);
}

}  // namespace farhorizon
