#pragma once

#include <algorithm>
#include <limits>
#include <stdexcept>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/io/dem/read_dem.h"
#include "tests/support/raw_tiff.h"
#include "tests/support/temp_dir.h"
#include "tests/support/test_raster.h"

namespace farhorizon {

/// Reads DEMs that a test has made in a folder of its own.
class DemFixture : public ::testing::Test {
 protected:
  static constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
  static constexpr double kInfinity = std::numeric_limits<double>::infinity();

  Result<Dem> Read(const TestRaster& raster, const DemReadOptions& options = {}) {
    WriteTiff(dir_ / "dem.tif", raster);
    return ReadDem(dir_ / "dem.tif", options);
  }
  Result<Dem> ReadRaw(const std::vector<RawImage>& images, const DemReadOptions& options = {}) {
    SpillFile(dir_ / "dem.tif", RawTiff(images));
    return ReadDem(dir_ / "dem.tif", options);
  }
  static Dem Must(Result<Dem> dem) {
    if (!dem) throw std::runtime_error(dem.error().message);
    return *std::move(dem);
  }
  Dem MustRead(const TestRaster& raster, const DemReadOptions& options = {}) {
    return Must(Read(raster, options));
  }
  /// The kind of the error; "read" where there is none.
  std::string KindOf(Result<Dem> dem) {
    if (dem) return "read";
    EXPECT_THAT(dem.error().message, ::testing::Not(::testing::HasSubstr(dir_.path().string())));
    EXPECT_FALSE(dem.error().message.empty());
    return dem.error().kind;
  }
  std::string KindOfTiff(const TestRaster& raster, const DemReadOptions& options = {}) {
    return KindOf(Read(raster, options));
  }
  /// Its message; "" where there is none.
  static std::string MessageOf(const Result<Dem>& dem) { return dem ? "" : dem.error().message; }

  /// Heights in metres, NaN where there is no data.
  static std::vector<double> Metres(const Dem& dem) {
    std::vector<double> metres;
    for (VertexId v = 0; v < dem.columns * dem.rows; ++v) {
      metres.push_back(dem.HasData(v) ? dem.HeightM(v) : kNan);
    }
    return metres;
  }
  static int PostsWithoutData(const Dem& dem) {
    return static_cast<int>(std::ranges::count(dem.heights, kNoHeight));
  }
  /// The codes of what was assumed, in order.
  static std::vector<std::string> Codes(const Dem& dem) {
    std::vector<std::string> codes;
    for (const Assumption& a : dem.assumptions) codes.push_back(a.code);
    return codes;
  }

  TempDir dir_;
};

}  // namespace farhorizon
