#include "core/io/horizon_vector.h"

#include <gdal.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <ogr_api.h>

#include "tests/support/published.h"
#include "tests/support/temp_dir.h"

namespace farhorizon {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

TEST(HorizonVector, ReadsBackThroughOgrWithAllItsFields) {
  const TempDir dir;
  HorizonFeature feature = SomeFeature();
  feature.level_kept = 1;
  for (const char* name : {"horizon.fgb", "horizon.gpkg"}) {
    Status written = WriteHorizonVector({SomeFeature(), feature, SomeFeature()}, dir / name);
    ASSERT_TRUE(written) << written.error().message;
    const GDALDatasetH dataset =
        GDALOpenEx((dir / name).c_str(), GDAL_OF_VECTOR, nullptr, nullptr, nullptr);
    ASSERT_NE(dataset, nullptr) << name;
    const OGRLayerH layer = GDALDatasetGetLayer(dataset, 0);
    EXPECT_EQ(OGR_L_GetFeatureCount(layer, 1), 3);
    int with_level = 0;
    while (const OGRFeatureH f = OGR_L_GetNextFeature(layer)) {
      EXPECT_EQ(OGR_F_GetFieldAsInteger(f, OGR_F_GetFieldIndex(f, "a_row")), 4);
      EXPECT_EQ(OGR_F_GetFieldAsInteger(f, OGR_F_GetFieldIndex(f, "direction_columns")), -7);
      EXPECT_EQ(OGR_F_GetFieldAsDouble(f, OGR_F_GetFieldIndex(f, "witness_t")), 0.1 + 0.2);
      EXPECT_STREQ(OGR_F_GetFieldAsString(f, OGR_F_GetFieldIndex(f, "azimuths")),
                   "[[12.5,13],[170.25,190.125]]");
      EXPECT_STREQ(OGR_F_GetFieldAsString(f, OGR_F_GetFieldIndex(f, "spans")),
                   "[[0,0.25],[0.5,1]]");
      EXPECT_EQ(OGR_F_GetFieldAsDouble(f, OGR_F_GetFieldIndex(f, "line_measure_m")), 3.5);
      with_level += OGR_F_IsFieldSetAndNotNull(f, OGR_F_GetFieldIndex(f, "level_kept"));
      const OGRGeometryH line = OGR_F_GetGeometryRef(f);
      EXPECT_EQ(OGR_G_GetX(line, 0), -84.25);
      EXPECT_EQ(OGR_G_GetZ(line, 0), 1076);
      OGR_F_Destroy(f);
    }
    EXPECT_EQ(with_level, 1);
    GDALClose(dataset);
  }
}

TEST(HorizonVector, LeavesTheWitnessOfAnUndecidedEdgeNull) {
  const TempDir dir;
  HorizonFeature undecided = SomeFeature();
  undecided.undecided = true;
  for (const char* name : {"horizon.fgb", "horizon.gpkg"}) {
    ASSERT_TRUE(WriteHorizonVector({SomeFeature(), undecided}, dir / name));
    const GDALDatasetH dataset =
        GDALOpenEx((dir / name).c_str(), GDAL_OF_VECTOR, nullptr, nullptr, nullptr);
    ASSERT_NE(dataset, nullptr) << name;
    const OGRLayerH layer = GDALDatasetGetLayer(dataset, 0);
    int with_witness = 0;
    while (const OGRFeatureH f = OGR_L_GetNextFeature(layer)) {
      with_witness += OGR_F_IsFieldSetAndNotNull(f, OGR_F_GetFieldIndex(f, "witness_t"));
      OGR_F_Destroy(f);
    }
    EXPECT_EQ(with_witness, 1) << name;
    GDALClose(dataset);
  }
}

TEST(HorizonVector, AnEdgeAcross180DegreesMakesALayerOfMultiLineStrings) {
  const TempDir dir;
  HorizonFeature across = SomeFeature();
  across.from.lon_deg = 179.5;
  across.to.lon_deg = -179.5;
  for (const char* name : {"horizon.fgb", "horizon.gpkg"}) {
    Status written = WriteHorizonVector({SomeFeature(), across}, dir / name);
    ASSERT_TRUE(written) << written.error().message;
    const GDALDatasetH dataset =
        GDALOpenEx((dir / name).c_str(), GDAL_OF_VECTOR, nullptr, nullptr, nullptr);
    ASSERT_NE(dataset, nullptr) << name;
    const OGRLayerH layer = GDALDatasetGetLayer(dataset, 0);
    EXPECT_EQ(OGR_L_GetGeomType(layer), wkbMultiLineString25D);
    int parts = 0;
    while (const OGRFeatureH f = OGR_L_GetNextFeature(layer)) {
      EXPECT_EQ(OGR_G_GetGeometryType(OGR_F_GetGeometryRef(f)), wkbMultiLineString25D);
      parts += OGR_G_GetGeometryCount(OGR_F_GetGeometryRef(f));
      OGR_F_Destroy(f);
    }
    EXPECT_EQ(parts, 3);
    GDALClose(dataset);
  }
}

TEST(HorizonVector, SameFeaturesSameBytes) {
  const TempDir dir;
  for (const char* ending : {".fgb", ".gpkg"}) {
    const std::filesystem::path one = dir / (std::string("horizon") + ending);
    ASSERT_TRUE(WriteHorizonVector({SomeFeature()}, one));
    const std::string first = SlurpFile(one);
    ASSERT_TRUE(WriteHorizonVector({SomeFeature()}, one));
    EXPECT_EQ(SlurpFile(one), first) << ending;
  }
  EXPECT_EQ(std::distance(std::filesystem::directory_iterator(dir.path()), {}), 2);
}

TEST(HorizonVector, FailsWithTheNameAndWithoutTheFolder) {
  const TempDir dir;
  for (const char* name : {"no/such/horizon.fgb", "no/such/horizon.gpkg"}) {
    Status written = WriteHorizonVector({SomeFeature()}, dir / name);
    ASSERT_FALSE(written) << name;
    EXPECT_EQ(written.error().code, ErrorCode::kIo);
    EXPECT_THAT(written.error().message, Not(HasSubstr(dir.path().string())));
  }
  EXPECT_EQ(WriteHorizonVector({}, dir / "horizon.shp").error().code, ErrorCode::kInvalidArgument);
}

}  // namespace
}  // namespace farhorizon
