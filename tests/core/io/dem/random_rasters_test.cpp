// Random rasters of every sample type, byte order, tiling, compression, nodata value, scale and
// offset that GDAL writes, in every format that it creates: ReadDem finds the values that GDAL
// itself finds in the same file, at the same places.
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <memory>
#include <optional>
#include <random>
#include <stdexcept>
#include <string>
#include <vector>

#include <cpl_conv.h>
#include <cpl_string.h>
#include <gdal.h>
#include <gtest/gtest.h>
#include <ogr_srs_api.h>

#include "core/io/dem/read_dem.h"
#include "tests/support/temp_dir.h"

namespace farhorizon {
namespace {

namespace fs = std::filesystem;

struct CloseDataset {
  void operator()(void* dataset) const { GDALClose(dataset); }
};
using DatasetPtr = std::unique_ptr<void, CloseDataset>;

void Must(bool done, const std::string& what) {
  if (!done) throw std::runtime_error(what + ": " + CPLGetLastErrorMsg());
}

// A sample type as GTiff writes it, with values that are heights in metres, and nodata values that
// it can hold.
struct SampleType {
  const char* name;
  GDALDataType type;
  double least;
  double greatest;
  bool whole;
  std::vector<double> nodata;
  std::string option = {};  // of creation
};

const double kNan = std::numeric_limits<double>::quiet_NaN();

const std::vector<SampleType>& SampleTypes() {
  static const std::vector<SampleType> types = {
      {"Byte", GDT_Byte, 1, 254, true, {0, 255}},
      {"Nibble", GDT_Byte, 1, 14, true, {0, 15}, "NBITS=4"},
      {"SignedByte", GDT_Byte, -127, 126, true, {-128, 127}, "PIXELTYPE=SIGNEDBYTE"},
      {"UInt16", GDT_UInt16, 0, 8000, true, {65535, 9999}},
      {"TwelveBits", GDT_UInt16, 0, 4000, true, {4095}, "NBITS=12"},
      {"Int16", GDT_Int16, -400, 8000, true, {-32768, -32767, -9999, 32767}},
      {"UInt32", GDT_UInt32, 0, 8000, true, {4294967295.0, 0}},
      {"Int32", GDT_Int32, -400, 8000, true, {-2147483648.0, -9999}},
      {"UInt64", GDT_UInt64, 0, 8000, true, {65535}},
      {"Int64", GDT_Int64, -400, 8000, true, {-9999}},
      {"HalfFloat", GDT_Float32, -400, 8000, false, {-10000, kNan}, "NBITS=16"},
      {"Float32", GDT_Float32, -400, 8000, false, {-9999, -3.4028234663852886e38, kNan, 0}},
      {"Float64", GDT_Float64, -400, 8000, false, {-9999, -1.7976931348623157e308, kNan}},
  };
  return types;
}

class RandomRaster {
 public:
  explicit RandomRaster(unsigned seed) : random_(seed) {}

  // One in `n`.
  bool Once(int n) { return Whole(1, n) == 1; }
  int Whole(int least, int greatest) {
    return std::uniform_int_distribution<int>(least, greatest)(random_);
  }
  template <typename T>
  const T& Of(const std::vector<T>& list) {
    return list[static_cast<std::size_t>(Whole(0, static_cast<int>(list.size()) - 1))];
  }
  double Value(const SampleType& type) {
    if (type.whole) return Whole(static_cast<int>(type.least), static_cast<int>(type.greatest));
    const double value = std::uniform_real_distribution<double>(type.least, type.greatest)(random_);
    return Once(2) ? std::round(value * 10) / 10 : value;
  }

  // What a GeoTIFF of `type` may look like inside.
  CPLStringList Layout(const SampleType& type) {
    CPLStringList options;
    if (!type.option.empty()) options.AddString(type.option.c_str());
    if (Once(2)) {
      options.SetNameValue("TILED", "YES");
      options.SetNameValue("BLOCKXSIZE", std::to_string(16 * Whole(1, 3)).c_str());
      options.SetNameValue("BLOCKYSIZE", std::to_string(16 * Whole(1, 3)).c_str());
    } else {
      options.SetNameValue("BLOCKYSIZE", std::to_string(Whole(1, 9)).c_str());
    }
    const std::string compression =
        Of(std::vector<std::string>{"NONE", "NONE", "LZW", "DEFLATE", "PACKBITS", "ZSTD", "LZMA"});
    options.SetNameValue("COMPRESS", compression.c_str());
    const bool big_endian = Once(3);
    if (big_endian) options.SetNameValue("ENDIANNESS", "BIG");
    const bool bits = type.option.starts_with("NBITS");
    // libtiff 4.5 does not read back what it writes with predictor 3 in the other byte order.
    if (!(big_endian && !type.whole) && compression != "NONE" && compression != "PACKBITS" &&
        compression != "LZMA" && !bits && Once(2)) {
      options.SetNameValue("PREDICTOR", type.whole ? "2" : "3");
    }
    if (Once(4)) options.SetNameValue("BIGTIFF", "YES");
    return options;
  }

  DatasetPtr Write(const fs::path& path, const SampleType& type, bool may_have_nodata = true) {
    columns_ = Whole(2, 60);
    rows_ = Whole(2, 60);
    DatasetPtr dataset(GDALCreate(GDALGetDriverByName("GTiff"), path.c_str(), columns_, rows_, 1,
                                  type.type, Layout(type).List()));
    Must(dataset != nullptr, "create");
    const double step = Once(2) ? 30 : 12.5;
    const bool south_up = Once(4);
    std::array<double, 6> place = {
        500000 + Whole(-90, 90) * 1000.0,  step, 0,
        5100000 + Whole(-90, 90) * 1000.0, 0,    south_up ? step : -step};
    Must(GDALSetGeoTransform(dataset.get(), place.data()) == CE_None, "place");
    const OGRSpatialReferenceH crs = OSRNewSpatialReference(nullptr);
    Must(OSRSetFromUserInput(crs, "EPSG:32610+5773") == OGRERR_NONE, "system");
    Must(GDALSetSpatialRef(dataset.get(), crs) == CE_None, "system");
    OSRRelease(crs);
    if (Once(3)) GDALSetMetadataItem(dataset.get(), "AREA_OR_POINT", "Point", nullptr);
    const GDALRasterBandH band = GDALGetRasterBand(dataset.get(), 1);
    std::optional<double> nodata;
    if (may_have_nodata && Once(2)) nodata = Of(type.nodata);
    if (nodata) SetNoData(band, type.type, *nodata);
    if (Once(3)) GDALSetRasterScale(band, Of(std::vector<double>{0.5, 0.1, 0.01}));
    if (Once(3)) GDALSetRasterOffset(band, Of(std::vector<double>{10, -100.5, 0.3}));
    std::vector<double> values;
    for (int i = 0; i < columns_ * rows_; ++i) {
      values.push_back(nodata && Once(10) ? *nodata : Value(type));
      if (type.option == "PIXELTYPE=SIGNEDBYTE" && values.back() < 0) {
        values.back() += 256;  // GDAL keeps signed bytes in unsigned ones
      }
    }
    Must(GDALRasterIO(band, GF_Write, 0, 0, columns_, rows_, values.data(), columns_, rows_,
                      GDT_Float64, 0, 0) == CE_None,
         "write");
    return dataset;
  }

 private:
  static void SetNoData(GDALRasterBandH band, GDALDataType type, double nodata) {
    if (type == GDT_Int64) {
      GDALSetRasterNoDataValueAsInt64(band, static_cast<std::int64_t>(nodata));
    } else if (type == GDT_UInt64) {
      GDALSetRasterNoDataValueAsUInt64(band, static_cast<std::uint64_t>(nodata));
    } else {
      GDALSetRasterNoDataValue(band, nodata);
    }
  }

  std::mt19937 random_;
  int columns_ = 0;
  int rows_ = 0;
};

// What GDAL itself finds in a file: metres, NaN where its mask says that there is no data, and the
// map coordinates of the posts in the corners.
struct Found {
  int columns = 0;
  int rows = 0;
  std::vector<double> metres;
  std::array<double, 2> first;
  std::array<double, 2> last;
};

Found FindWithGdal(const fs::path& path) {
  const DatasetPtr dataset(
      GDALOpenEx(path.c_str(), GDAL_OF_RASTER | GDAL_OF_READONLY, nullptr, nullptr, nullptr));
  Must(dataset != nullptr, "open " + path.filename().string());
  const GDALRasterBandH band = GDALGetRasterBand(dataset.get(), 1);
  Found found;
  found.columns = GDALGetRasterXSize(dataset.get());
  found.rows = GDALGetRasterYSize(dataset.get());
  const std::size_t posts = static_cast<std::size_t>(found.columns) * found.rows;
  found.metres.resize(posts);
  std::vector<std::uint8_t> mask(posts);
  Must(GDALRasterIO(band, GF_Read, 0, 0, found.columns, found.rows, found.metres.data(),
                    found.columns, found.rows, GDT_Float64, 0, 0) == CE_None,
       "read");
  Must(GDALRasterIO(GDALGetMaskBand(band), GF_Read, 0, 0, found.columns, found.rows, mask.data(),
                    found.columns, found.rows, GDT_Byte, 0, 0) == CE_None,
       "read the mask");
  const char* pixel = GDALGetMetadataItem(band, "PIXELTYPE", "IMAGE_STRUCTURE");
  const bool is_signed = pixel != nullptr && std::string(pixel) == "SIGNEDBYTE";
  int has_nodata = 0;
  const double nodata = GDALGetRasterNoDataValue(band, &has_nodata);
  for (std::size_t i = 0; i < posts; ++i) {
    double& value = found.metres[i];
    if (is_signed && value > 127) value -= 256;
    // The mask of signed bytes hides what the nodata value is as an unsigned one.
    const bool none = is_signed ? has_nodata != 0 && value == nodata : mask[i] == 0;
    value = none ? kNan
                 : value * GDALGetRasterScale(band, nullptr) + GDALGetRasterOffset(band, nullptr);
  }
  std::array<double, 6> place{};
  Must(GDALGetGeoTransform(dataset.get(), place.data()) == CE_None, "place");
  const auto at = [&](double column, double row) {
    return std::array{place[0] + column * place[1], place[3] + row * place[5]};
  };
  found.first = at(0.5, 0.5);
  found.last = at(found.columns - 0.5, found.rows - 0.5);
  return found;
}

// relative: what reading may round heights by, as a share of them.
void ExpectTheSame(const Dem& dem, const Found& found, double relative = 1e-9) {
  ASSERT_EQ(dem.columns, found.columns);
  ASSERT_EQ(dem.rows, found.rows);
  const GeoTransform& place = dem.transform;
  const double tolerance = 1e-6 * std::abs(place.step_x);
  EXPECT_NEAR(place.origin_x, found.first[0], tolerance);
  EXPECT_NEAR(place.origin_y, found.first[1], tolerance);
  EXPECT_NEAR(place.origin_x + (dem.columns - 1) * place.step_x, found.last[0], tolerance);
  EXPECT_NEAR(place.origin_y + (dem.rows - 1) * place.step_y, found.last[1], tolerance);
  for (VertexId v = 0; v < dem.columns * dem.rows; ++v) {
    const double metres = found.metres[static_cast<std::size_t>(v)];
    ASSERT_EQ(dem.HasData(v), !std::isnan(metres)) << "post " << v << ", " << metres;
    if (!dem.HasData(v)) continue;
    ASSERT_NEAR(dem.HeightM(v), metres,
                std::max(dem.quantized ? dem.quantum_m : 0, relative * 8000))
        << "post " << v;
  }
}

class RandomRasters : public ::testing::TestWithParam<unsigned> {
 protected:
  static void SetUpTestSuite() { GDALAllRegister(); }
};

TEST_P(RandomRasters, OfGeoTiffAreReadAsGdalReadsThem) {
  RandomRaster random(GetParam());
  for (const SampleType& type : SampleTypes()) {
    SCOPED_TRACE(type.name);
    const TempDir folder;
    random.Write(folder / "dem.tif", type);
    const Result<Dem> dem = ReadDem(folder / "dem.tif", {});
    ASSERT_TRUE(dem) << dem.error().message;
    ExpectTheSame(*dem, FindWithGdal(folder / "dem.tif"));
  }
}

struct Format {
  const char* driver;
  const char* ending;
  std::vector<GDALDataType> types;
  bool keeps_nodata = true;
};

TEST_P(RandomRasters, OfOtherFormatsAreReadAsGdalReadsThem) {
  RandomRaster random(1000 + GetParam());
  const std::vector<GDALDataType> all = {GDT_Byte,  GDT_UInt16,  GDT_Int16,  GDT_UInt32,
                                         GDT_Int32, GDT_Float32, GDT_Float64};
  const Format formats[] = {{"AAIGrid", "asc", all},
                            {"ENVI", "img", all},
                            {"HFA", "img", all},
                            {"EHdr", "bil", {GDT_Byte, GDT_Int16, GDT_UInt16, GDT_Float32}},
                            {"EHdr", "flt", {GDT_Float32}},
                            {"GSAG", "grd", all},
                            {"GSBG", "grd", {GDT_Int16, GDT_Float32}},
                            {"GS7BG", "grd", {GDT_Int16, GDT_Float32, GDT_Float64}},
                            {"XYZ", "xyz", all, false}};
  for (const Format& format : formats) {
    const GDALDataType wanted = random.Of(format.types);
    SCOPED_TRACE(std::string(format.driver) + " of " + GDALGetDataTypeName(wanted));
    SampleType type = *std::ranges::find(SampleTypes(), wanted, &SampleType::type);
    const TempDir folder;
    const DatasetPtr source = random.Write(folder / "source.tif", type, format.keeps_nodata);
    GDALSetRasterScale(GDALGetRasterBand(source.get(), 1), 1);
    GDALSetRasterOffset(GDALGetRasterBand(source.get(), 1), 0);
    std::array<double, 6> place{};
    GDALGetGeoTransform(source.get(), place.data());
    place[5] = -std::abs(place[5]);  // few of these formats keep rows from the south
    GDALSetGeoTransform(source.get(), place.data());
    const fs::path path = folder / (std::string("dem.") + format.ending);
    CPLSetThreadLocalConfigOption("GDAL_PAM_ENABLED", "NO");
    DatasetPtr copy(GDALCreateCopy(GDALGetDriverByName(format.driver), path.c_str(), source.get(),
                                   FALSE, nullptr, nullptr, nullptr));
    CPLSetThreadLocalConfigOption("GDAL_PAM_ENABLED", nullptr);
    ASSERT_NE(copy, nullptr);
    copy.reset();  // ENVI writes its header last
    const Result<Dem> dem = ReadDem(path, {.crs = "EPSG:32610+5773"});
    ASSERT_TRUE(dem) << dem.error().message;
    // Decimals of text grids are read as floats, with 24 bits.
    ExpectTheSame(*dem, FindWithGdal(path), std::ldexp(1.0, -24));
  }
}

INSTANTIATE_TEST_SUITE_P(Seeds, RandomRasters, ::testing::Range(0U, 24U));
INSTANTIATE_TEST_SUITE_P(SeedsLong, RandomRasters, ::testing::Range(24U, 40U));

}  // namespace
}  // namespace farhorizon
