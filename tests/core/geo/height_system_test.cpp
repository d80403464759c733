#include "core/geo/height_system.h"

#include <stdexcept>

#include <gtest/gtest.h>

namespace farhorizon {
namespace {

CrsUnits Units(const std::string& crs) {
  Result<CrsUnits> units = ReadCrsUnits(crs);
  if (!units) throw std::runtime_error(units.error().message);
  return *units;
}

TEST(ReadCrsUnits, SaysUnitDirectionAndWhetherADatumIsNamed) {
  EXPECT_FALSE(Units("EPSG:4326").heights);
  const CrsUnits feet = Units("EPSG:26913+6360");
  ASSERT_TRUE(feet.heights);
  EXPECT_EQ(feet.heights->name, "EPSG:6360");
  EXPECT_EQ(feet.heights->unit, "US survey foot");
  EXPECT_NEAR(feet.heights->unit_m, 1200.0 / 3937, 1e-12);
  EXPECT_FALSE(feet.heights->down);
  EXPECT_TRUE(feet.heights->names_datum);
  ASSERT_TRUE(Units("EPSG:4326+5715").heights);
  EXPECT_TRUE(Units("EPSG:4326+5715").heights->down);
  ASSERT_TRUE(Units("EPSG:4979").heights);
  EXPECT_TRUE(Units("EPSG:4979").heights->names_datum);
}

TEST(ReadCrsUnits, SaysTheUnitOfTheMap) {
  EXPECT_FALSE(Units("EPSG:4326").map_unit_m);
  EXPECT_EQ(Units("EPSG:32613").map_unit_m, 1);
  EXPECT_EQ(Units("EPSG:6529").map_unit, "US survey foot");
  EXPECT_NEAR(*Units("+proj=utm +zone=13 +datum=WGS84 +to_meter=0.3048").map_unit_m, 0.3048, 1e-12);
  EXPECT_EQ(Units("+proj=utm +zone=13 +datum=WGS84 +to_meter=0.5").map_unit, "0.5 m");
}

TEST(ReadHeightSystem, IsNoneForTheEllipsoid) {
  Result<std::optional<HeightSystem>> none = ReadHeightSystem("Ellipsoid");
  ASSERT_TRUE(none);
  EXPECT_FALSE(*none);
  Result<std::optional<HeightSystem>> egm96 = ReadHeightSystem("EGM96");
  ASSERT_TRUE(egm96);
  ASSERT_TRUE(*egm96);
  EXPECT_EQ((*egm96)->name, "EPSG:5773");
  EXPECT_FALSE(ReadHeightSystem("EPSG:4326"));
}

TEST(ListedLengthUnit, IsFoundByNameAndCode) {
  ASSERT_TRUE(ListedLengthUnit("9003"));
  EXPECT_EQ(ListedLengthUnit("9003")->name, "US survey foot");
  ASSERT_TRUE(ListedLengthUnit("FATHOM"));
  EXPECT_EQ(ListedLengthUnit("FATHOM")->metres, 1.8288);
  EXPECT_FALSE(ListedLengthUnit("9102"));  // degree
  EXPECT_FALSE(ListedLengthUnit("kelvin"));
}

}  // namespace
}  // namespace farhorizon
