// libFuzzer's target: DEM files that strangers send, in every format, with what may lie beside
// them. Such a file is read and placed on the globe, or refused; what is read has finite heights at
// finite places.
//
// An input is a byte that chooses the name and the options, two bytes (little-endian) with the
// length of the file beside, that file, and the DEM. tests/fuzz/dem_corpus makes such inputs.
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <iostream>
#include <string>
#include <string_view>
#include <vector>

#include "core/pipeline/terrain_input.h"
#include "tests/support/temp_dir.h"

namespace {

using namespace farhorizon;

struct Names {
  std::string_view dem;
  std::string_view beside;
};
// dem_corpus counts on this order.
constexpr std::array<Names, 16> kNames = {{{"dem.tif", ""},
                                           {"dem.tif", "dem.tfw"},
                                           {"dem.tif", "dem.tif.aux.xml"},
                                           {"dem.tif", "dem.tif.msk"},
                                           {"dem.asc", "dem.prj"},
                                           {"N38E007.hgt", ""},
                                           {"N38E007.hgt.zip", ""},
                                           {"dem.dt0", ""},
                                           {"dem.dem", ""},
                                           {"dem.img", "dem.hdr"},
                                           {"dem.img", ""},
                                           {"dem.flt", "dem.hdr"},
                                           {"dem.bil", "dem.hdr"},
                                           {"dem.grd", ""},
                                           {"dem.xyz", ""},
                                           {"dem", ""}}};
// A whole SRTM tile of three seconds, the largest raster of a corpus.
constexpr std::int64_t kMaxPosts = 1201 * 1201;

void Require(bool holds, const char* what) {
  if (holds) return;
  std::cerr << "offence: " << what << std::endl;
  std::abort();
}

BuildOptions OptionsOf(unsigned choice) {
  BuildOptions options;
  options.max_posts = kMaxPosts;
  if ((choice & 1U) != 0) options.crs = "EPSG:32632";
  if ((choice & 2U) != 0) options.nodata = {-9999, 0};
  if ((choice & 4U) != 0) options.height_unit = "ft";
  if ((choice & 8U) != 0) options.vertical_datum = "EPSG:5773";
  return options;
}

void CheckInput(const TerrainInput& input) {
  const Dem& dem = input.dem();
  Require(dem.columns >= 2 && dem.rows >= 2, "a terrain has two posts a side");
  Require(std::int64_t{dem.columns} * dem.rows <= kMaxPosts, "the limit on posts holds");
  Require(std::ssize(dem.heights) == std::int64_t{dem.columns} * dem.rows,
          "every post has a height, or none");
  const auto [least, greatest] = input.report().heights_m;
  Require(std::isfinite(least) && std::isfinite(greatest) && least <= greatest,
          "heights are finite");
  for (const Assumption& assumption : input.assumptions()) {
    Require(!assumption.code.empty() && !assumption.text.empty(), "an assumption says what");
    Require(assumption.text.size() < 2000, "an assumption is a sentence");
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size < 3) return 0;
  const TempDir folder;
  const Names& names = kNames[data[0] % kNames.size()];
  const std::string_view rest(reinterpret_cast<const char*>(data) + 3, size - 3);
  const std::size_t beside =
      names.beside.empty()
          ? 0
          : std::min<std::size_t>(data[1] + std::size_t{256} * data[2], rest.size());
  if (beside > 0) {
    SpillFile(folder / std::string(names.beside), std::string(rest.substr(0, beside)));
  }
  const std::filesystem::path dem = folder / std::string(names.dem);
  SpillFile(dem, std::string(rest.substr(beside)));
  const auto input = TerrainInput::Open(dem, OptionsOf(data[0] / kNames.size()), {});
  if (input) {
    CheckInput(**input);
  } else {
    Require(!input.error().message.empty(), "an error says what");
    Require(input.error().message.find(folder.path().string()) == std::string::npos,
            "an error names no folder");
    Require(input.error().message.size() < 4000, "an error is a sentence");
  }
  return 0;
}
