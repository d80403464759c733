#include "core/io/dem/values/height_unit.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace farhorizon {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

const HeightUnit kMetre = {"metre", 1, "one that says metres"};
const HeightUnit kFoot = {"foot", 0.3048, "one that says feet"};
const HeightUnit kSurveyFoot = {"US survey foot", 1200.0 / 3937, "one that says survey feet"};

TEST(ReadHeightUnit, KnowsTheSpellingsOfPeopleAndFormats) {
  const std::pair<const char*, double> kUnits[] = {{"m", 1},
                                                   {"Meter", 1},
                                                   {"METRES", 1},
                                                   {"[m]", 1},
                                                   {"meters above sea level", 1},
                                                   {"Meters (above MSL)", 1},
                                                   {"m a.s.l.", 1},
                                                   {"ft", 0.3048},
                                                   {"Feet", 0.3048},
                                                   {"[ft_i]", 0.3048},
                                                   {"International Foot", 0.3048},
                                                   {"us-ft", 1200.0 / 3937},
                                                   {"[ft_us]", 1200.0 / 3937},
                                                   {"US survey foot", 1200.0 / 3937},
                                                   {"U.S. Survey Feet", 1200.0 / 3937},
                                                   {"Foot_US", 1200.0 / 3937},
                                                   {"ftUS", 1200.0 / 3937},
                                                   {"feet above NAVD88", 0.3048},
                                                   {"fathom", 1.8288},
                                                   {"yard", 0.9144},
                                                   {"km", 1000},
                                                   {"cm", 0.01},
                                                   {"Clarke's foot", 0.3047972654},
                                                   {"British foot (Sears 1922)", 0.3047994715386}};
  for (const auto& [name, metres] : kUnits) {
    Result<HeightUnit> unit = ReadHeightUnit(name);
    ASSERT_TRUE(unit) << name;
    EXPECT_NEAR(unit->metres, metres, 1e-12 * metres) << name;
  }
}

TEST(ReadHeightUnit, RefusesOthersAndSaysWhatStatesThem) {
  for (const char* name :
       {"kelvin", "degree", "m*10", "m/s", "dBm", "1", "counts", "above ground"}) {
    Result<HeightUnit> unit = ReadHeightUnit(name);
    ASSERT_FALSE(unit) << name;
    EXPECT_EQ(unit.error().kind, "unknown-unit");
    EXPECT_THAT(unit.error().message, AllOf(HasSubstr(name), HasSubstr("--height-unit")));
  }
}

TEST(DecideHeightUnit, TakesWhatIsStatedWhateverOthersSay) {
  Assumptions assumptions;
  EXPECT_EQ(
      DecideHeightUnit({.stated = kFoot, .band = kMetre, .file_key = kSurveyFoot}, assumptions)
          .metres,
      kFoot.metres);
  EXPECT_THAT(assumptions, IsEmpty());
}

TEST(DecideHeightUnit, TakesTheBandsOwnBeforeThoseOfSystems) {
  Assumptions assumptions;
  EXPECT_EQ(DecideHeightUnit({.band = kSurveyFoot, .call_system = kMetre}, assumptions).metres,
            kSurveyFoot.metres);
  ASSERT_EQ(assumptions.size(), 1U);
  EXPECT_EQ(assumptions[0].code, "height-unit");
  EXPECT_THAT(assumptions[0].text,
              AllOf(HasSubstr("US survey foot"), HasSubstr("metre"), HasSubstr("--height-unit")));
  EXPECT_EQ(DecideHeightUnit({.band = kMetre, .call_system = kFoot}, assumptions).metres, 1);
  EXPECT_EQ(assumptions.size(), 2U);
}

TEST(DecideHeightUnit, TakesFeetBeforeMetresOfSystemsThatAreNamedForTheirDatum) {
  Assumptions assumptions;
  EXPECT_EQ(DecideHeightUnit({.call_system = kMetre, .file_system = kFoot}, assumptions).metres,
            kFoot.metres);
  EXPECT_EQ(DecideHeightUnit({.call_system = kFoot, .file_system = kMetre}, assumptions).metres,
            kFoot.metres);
  EXPECT_EQ(DecideHeightUnit({.file_key = kFoot, .file_system = kMetre}, assumptions).metres,
            kFoot.metres);
  EXPECT_EQ(
      DecideHeightUnit({.call_system = kSurveyFoot, .file_system = kFoot}, assumptions).metres,
      kSurveyFoot.metres);
  EXPECT_EQ(assumptions.size(), 4U);
}

TEST(DecideHeightUnit, IsSilentWhereAllAgree) {
  Assumptions assumptions;
  EXPECT_EQ(DecideHeightUnit({.call_system = kMetre}, assumptions).metres, 1);
  EXPECT_EQ(DecideHeightUnit({.file_system = kFoot}, assumptions).metres, kFoot.metres);
  const HeightUnit rounded = {"US survey foot", 0.30480061, "a file"};
  DecideHeightUnit({.band = rounded, .file_system = kSurveyFoot}, assumptions);
  EXPECT_THAT(assumptions, IsEmpty());
}

TEST(DecideHeightUnit, SaysMetresWhereNothingIsSaid) {
  Assumptions assumptions;
  EXPECT_EQ(DecideHeightUnit({}, assumptions).metres, 1);
  EXPECT_EQ(DecideHeightUnit({.map_unit = "US survey foot"}, assumptions).metres, 1);
  ASSERT_EQ(assumptions.size(), 2U);
  EXPECT_THAT(assumptions[0].text, AllOf(HasSubstr("metres"), HasSubstr("--height-unit")));
  EXPECT_THAT(assumptions[1].text, HasSubstr("US survey foot"));
}

TEST(DecideHeightUnit, SaysMetresOfTheCallsDatumOverAMapInFeet) {
  Assumptions assumptions;
  EXPECT_EQ(DecideHeightUnit({.call_system = kMetre, .map_unit = "foot"}, assumptions).metres, 1);
  ASSERT_EQ(assumptions.size(), 1U);
  EXPECT_THAT(assumptions[0].text, HasSubstr("--height-unit"));
  DecideHeightUnit({.call_system = kMetre, .file_system = kMetre, .map_unit = "foot"}, assumptions);
  DecideHeightUnit({.file_system = kMetre, .map_unit = "foot"}, assumptions);
  EXPECT_EQ(assumptions.size(), 1U);
}

}  // namespace
}  // namespace farhorizon
