// The comparison of the engines sees what it is there for.
#include "tests/support/engine_agreement.h"

#include <fstream>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/horizon/find_horizon.h"
#include "tests/support/ascii_dem.h"
#include "tests/support/engines_agree.h"
#include "tests/support/terrains.h"

namespace farhorizon {
namespace {

using testing::HasSubstr;

Engines WithAdaptive(const std::function<void(Horizon&)>& change) {
  Engines engines;
  engines.adaptive = [change](const Terrain& terrain) {
    Horizon horizon = *FindHorizon(terrain, {}, {});
    change(horizon);
    return Result<Horizon>(std::move(horizon));
  };
  return engines;
}

Engines WithKinetic(const Result<KineticHorizon>& answer) {
  Engines engines;
  engines.kinetic = [answer](const Terrain&) { return answer; };
  return engines;
}

TEST(EngineOffence, IsEmptyWhereTheEnginesAgreeAndOnADemWithoutSurface) {
  EXPECT_EQ(EngineOffence(Crater(true, false, true), {}), "");
  EXPECT_EQ(EngineOffence(AsciiDem("..\n.1"), {}), "");
}

TEST(EngineOffence, NamesAnEdgeThatOneEngineMisses) {
  const Dem pyramid = AsciiDem(".0.\n010\n.0.");
  const Engines engines = WithAdaptive([](Horizon& horizon) { horizon.edges.pop_back(); });
  EXPECT_EQ(EngineOffence(pyramid, engines),
            "the adaptive engine and the kinetic engine differ; only the latter: 4-7");
}

TEST(EngineOffence, NamesAnEdgeThatBothMissWhereTheDefinitionIsAsked) {
  Engines engines = WithAdaptive([](Horizon& horizon) { horizon.edges.clear(); });
  engines.kinetic = [](const Terrain&) { return Result<KineticHorizon>(KineticHorizon{}); };
  engines.approximate = engines.adaptive;
  const Dem pyramid = AsciiDem(".0.\n010\n.0.");
  EXPECT_EQ(EngineOffence(pyramid, engines), "");
  engines.posts_by_definition = 9;
  EXPECT_THAT(EngineOffence(pyramid, engines),
              HasSubstr("the adaptive engine and the definition differ; only the latter: 1-4"));
}

TEST(EngineOffence, SeesAWitnessThatDoesNotHold) {
  const Dem pyramid = AsciiDem("000\n010\n000");
  const Engines engines = WithAdaptive(
      [](Horizon& horizon) { horizon.edges.front().witness = {.t = 0.5, .dc = 1, .dr = 1}; });
  EXPECT_THAT(EngineOffence(pyramid, engines),
              HasSubstr("a witness does not hold: edge 0-4 t 0.5"));
}

TEST(EngineOffence, AllowsAnEngineItsDocumentedErrorOnly) {
  const Dem pyramid = AsciiDem(".0.\n010\n.0.");
  const ErrorCode code = ErrorCode::kUnsupportedData;
  EXPECT_EQ(EngineOffence(pyramid, WithKinetic(Error{code, "no", "kinetic-too-large"})), "");
  EXPECT_EQ(EngineOffence(pyramid, WithKinetic(Error{code, "no", "no-surface"})),
            "the kinetic engine says: no");
}

TEST(EngineOffence, SeesAnApproximateSetThatIsNoSupersetOrDecidesWrongly) {
  const Dem pyramid = AsciiDem("000\n010\n000");
  Engines engines;
  engines.approximate = [](const Terrain&) { return Result<Horizon>(Horizon{}); };
  EXPECT_EQ(EngineOffence(pyramid, engines), "the approximate set is no superset");
  engines = WithAdaptive([](Horizon& horizon) { horizon.edges.pop_back(); });
  engines.kinetic = [](const Terrain& terrain) {
    KineticHorizon horizon = *FindHorizonKinetic(terrain, {});
    horizon.edges.pop_back();
    return Result<KineticHorizon>(std::move(horizon));
  };
  engines.approximate = [](const Terrain& terrain) { return FindHorizon(terrain, {}, {}); };
  EXPECT_EQ(EngineOffence(pyramid, engines),
            "the approximate set has decided for an edge that is not on the horizon");
}

TEST(EngineOffence, TurnsABrokenInvariantIntoAnOffence) {
  Engines engines;
  engines.kinetic = [](const Terrain&) -> Result<KineticHorizon> {
    throw InternalError("a hull is a hull");
  };
  EXPECT_EQ(EngineOffence(AsciiDem("01\n10"), engines), "it throws: a hull is a hull");
}

TEST(EnginesAgree, LeavesAPictureOfTheSweepWhereTheyDoNot) {
  EXPECT_TRUE(EnginesAgree(Crater(false, true, false)));
  const Engines engines = WithAdaptive([](Horizon& horizon) {
    std::erase_if(horizon.edges, [](const HorizonEdge& e) { return e.edge.b == 4; });
  });
  const testing::AssertionResult result = EnginesAgree(AsciiDem("000\n090\n000"), engines);
  ASSERT_FALSE(result);
  const std::string message = result.message();
  EXPECT_THAT(message, HasSubstr("the adaptive engine and the kinetic engine differ"));
  const std::string path = message.substr(message.find("picture: ") + 9);
  std::ifstream picture(path);
  ASSERT_TRUE(picture) << message;
  std::string first;
  std::getline(picture, first);
  EXPECT_THAT(first, testing::StartsWith("<svg "));
}

TEST(SmallestOffence, DrawsTheLeastThatStillOffends) {
  const Engines engines = WithAdaptive([](Horizon& horizon) { horizon.edges.pop_back(); });
  EXPECT_THAT(SmallestOffence(Crater(false, true, false), engines),
              HasSubstr("on this DEM, the smallest found:\n. 0\n0 0\n"));
}

}  // namespace
}  // namespace farhorizon
