#include "core/io/dem/aux_file.h"

#include "tests/support/dem_fixture.h"

namespace farhorizon {
namespace {

using ::testing::Contains;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::Not;

class AuxFiles : public DemFixture {
 protected:
  Result<Dem> ReadWith(const std::string& inside, const TestRaster& raster = {},
                       const DemReadOptions& options = {}) {
    WriteTiff(dir_ / "dem.tif", raster);
    SpillFile(dir_ / "dem.tif.aux.xml", "<PAMDataset>" + inside + "</PAMDataset>\n");
    return ReadDem(dir_ / "dem.tif", options);
  }
  Result<Dem> ReadWithBand(const std::string& inside, const TestRaster& raster = {},
                           const DemReadOptions& options = {}) {
    return ReadWith("<PAMRasterBand band=\"1\">" + inside + "</PAMRasterBand>", raster, options);
  }
  static bool Said(const Dem& dem) { return ::testing::Matches(Contains("aux-file"))(Codes(dem)); }
};

TEST_F(AuxFiles, NodataCountsBesideTheFilesOwn) {
  const std::string nodata = "<NoDataValue le_hex_equiv=\"0000000000001840\">6</NoDataValue>";
  EXPECT_EQ(Must(ReadWithBand(nodata)).heights[5], kNoHeight);
  EXPECT_EQ(PostsWithoutData(Must(ReadWithBand(nodata, {.nodata = 1}))), 2);
  EXPECT_EQ(PostsWithoutData(Must(ReadWithBand(nodata, {.nodata = 1}, {.nodata = {2}}))), 3);
  EXPECT_FALSE(Said(Must(ReadWithBand(nodata))));
}

TEST_F(AuxFiles, OfAnotherBandSayNothing) {
  EXPECT_EQ(PostsWithoutData(Must(ReadWith("<PAMRasterBand band=\"2\"><NoDataValue>6</NoDataValue>"
                                           "</PAMRasterBand>"))),
            0);
}

TEST_F(AuxFiles, ScaleOffsetAndUnitCount) {
  const Dem dem =
      Must(ReadWithBand("<Offset>100</Offset><Scale>0.5</Scale><UnitType>ft</UnitType>"));
  EXPECT_DOUBLE_EQ(dem.HeightM(5), (6 * 0.5 + 100) * 0.3048);
  EXPECT_FALSE(Said(dem));
}

TEST_F(AuxFiles, WinOverTheFileAndThatIsSaid) {
  const Dem dem = Must(ReadWithBand("<Scale>0.5</Scale>", {.scale = 2}));
  EXPECT_DOUBLE_EQ(dem.HeightM(5), 3);
  EXPECT_TRUE(Said(dem));
  EXPECT_TRUE(Said(Must(ReadWithBand("<UnitType>ft</UnitType>", {.unit = "m"}))));
  EXPECT_FALSE(
      Said(Must(ReadWithBand("<UnitType>ft</UnitType>", {.unit = "m"}, {.height_unit = "ft"}))));
  EXPECT_FALSE(Said(Must(ReadWithBand("<Scale>2</Scale>", {.scale = 2}))));
}

TEST_F(AuxFiles, PlaceTheRaster) {
  const std::string place =
      "<GeoTransform> 6.0e+05, 3.0e+01, 0, 5.1e+06, 0, -3.0e+01</GeoTransform>";
  const Dem dem = Must(ReadWith(place, {.geotransform = std::nullopt}));
  EXPECT_EQ(dem.transform.origin_x, 600015);
  EXPECT_FALSE(Said(dem));
  EXPECT_EQ(Must(ReadWith(place)).transform.origin_x, 600015);
  EXPECT_TRUE(Said(Must(ReadWith(place))));
  EXPECT_TRUE(Said(Must(ReadWith("<GeoTransform>1, 2, 3</GeoTransform>"))));
}

TEST_F(AuxFiles, NameTheReferenceSystem) {
  // As GDAL writes it, by name and code.
  const std::string utm11 =
      "<SRS dataAxisToSRSAxisMapping=\"1,2\">PROJCS[\"WGS 84 / UTM zone 11N\",GEOGCS[\"WGS 84\","
      "DATUM[\"WGS_1984\",SPHEROID[\"WGS 84\",6378137,298.257223563]],PRIMEM[\"Greenwich\",0],"
      "UNIT[\"degree\",0.0174532925199433]],PROJECTION[\"Transverse_Mercator\"],"
      "PARAMETER[\"latitude_of_origin\",0],PARAMETER[\"central_meridian\",-117],"
      "PARAMETER[\"scale_factor\",0.9996],PARAMETER[\"false_easting\",500000],"
      "PARAMETER[\"false_northing\",0],UNIT[\"metre\",1],AUTHORITY[\"EPSG\",\"32611\"]]</SRS>";
  EXPECT_EQ(Must(ReadWith(utm11, {.crs = ""})).crs, "EPSG:32611");
  const Dem both = Must(ReadWith(utm11));
  EXPECT_EQ(both.crs, "EPSG:32611");
  EXPECT_TRUE(Said(both));
  EXPECT_FALSE(Said(Must(ReadWith(utm11, {.crs = "EPSG:32611"}))));
  EXPECT_FALSE(Said(Must(ReadWith(utm11, {}, {.crs = "EPSG:32610"}))));
}

TEST_F(AuxFiles, NeverNameAFileThatIsOpened) {
  SpillFile(dir_ / "secret.wkt", "PROJCS[\"not to be read\"]");
  const Result<Dem> dem =
      ReadWith("<SRS>" + (dir_ / "secret.wkt").string() +
               "</SRS><Metadata domain=\"OVERVIEWS\"><MDI key=\"OVERVIEW_FILE\">secret.tif</MDI>"
               "</Metadata>");
  EXPECT_EQ(Must(dem).crs, "EPSG:32610");
  EXPECT_TRUE(Said(*dem));
}

TEST_F(AuxFiles, StatisticsAndHistogramsAreNotWorthAWord) {
  EXPECT_FALSE(Said(Must(ReadWithBand(
      "<Histograms><HistItem><HistMin>1</HistMin></HistItem></Histograms><Metadata><MDI "
      "key=\"STATISTICS_MAXIMUM\">6</MDI></Metadata>"))));
}

TEST_F(AuxFiles, WhatIsNotReadIsSaid) {
  EXPECT_TRUE(Said(Must(ReadWith("<GCPList Projection=\"\"/>"))));
  EXPECT_TRUE(
      Said(Must(ReadWith("<Metadata domain=\"xml:ESRI\" format=\"xml\"><GeodataXform "
                         "xsi:type=\"typens:PolynomialXform\"/></Metadata>"))));
  EXPECT_FALSE(
      Said(Must(ReadWith("<Metadata domain=\"xml:ESRI\" format=\"xml\"><GeodataXform "
                         "xsi:type=\"typens:IdentityXform\"/></Metadata>"))));
  for (const char* text : {"", "no XML", "<PAMDataset>", "<Other/>"}) {
    WriteTiff(dir_ / "dem.tif", {});
    SpillFile(dir_ / "dem.tif.aux.xml", text);
    EXPECT_TRUE(Said(Must(ReadDem(dir_ / "dem.tif", {})))) << text;
  }
}

TEST_F(AuxFiles, StandBesideOtherFormatsToo) {
  SpillFile(dir_ / "dem.asc",
            "ncols 3\nnrows 2\nxllcorner 10\nyllcorner 20\ncellsize 2\n1 2 3\n4 5 6\n");
  SpillFile(dir_ / "dem.asc.aux.xml",
            "<PAMDataset><PAMRasterBand band=\"1\"><NoDataValue>6</NoDataValue><UnitType>ft"
            "</UnitType></PAMRasterBand></PAMDataset>");
  const Dem dem = Must(ReadDem(dir_ / "dem.asc", {.crs = "EPSG:32610"}));
  EXPECT_EQ(PostsWithoutData(dem), 1);
  EXPECT_DOUBLE_EQ(dem.HeightM(0), 0.3048);
}

TEST_F(AuxFiles, ReadingThemWritesNothing) {
  ASSERT_TRUE(ReadWithBand("<Scale>2</Scale><NoDataValue>6</NoDataValue>"));
  const std::string text = SlurpFile(dir_ / "dem.tif.aux.xml");
  EXPECT_THAT(text, HasSubstr("<Scale>2</Scale><NoDataValue>6</NoDataValue>"));
  EXPECT_EQ(std::distance(std::filesystem::directory_iterator(dir_.path()), {}), 2);
}

}  // namespace
}  // namespace farhorizon
