// A picture must not pass for heights, nor heights with a palette for a picture. What tells them
// apart is the number of bands, their colour interpretation and the width of the samples; every
// refusal names the command that makes a DEM of the raster.
#include "core/io/dem/height_band.h"

#include <algorithm>
#include <string>
#include <vector>

#include <gdal.h>

namespace farhorizon {

namespace {

struct Bands {
  int count = 0;
  std::vector<int> alpha;  // numbers of bands
  bool coloured = false;
};

Bands Survey(GDALDatasetH dataset) {
  Bands bands;
  bands.count = GDALGetRasterCount(dataset);
  for (int b = 1; b <= bands.count; ++b) {
    const GDALColorInterp colour = GDALGetRasterColorInterpretation(GDALGetRasterBand(dataset, b));
    if (colour == GCI_AlphaBand) bands.alpha.push_back(b);
    bands.coloured = bands.coloured || (colour >= GCI_RedBand && colour <= GCI_BlueBand) ||
                     (colour >= GCI_HueBand && colour <= GCI_YCbCr_CrBand);
  }
  return bands;
}

Error SeveralBands(GDALDatasetH dataset, const Bands& bands) {
  const std::string count = std::to_string(bands.count);
  if (bands.coloured) {
    return {ErrorCode::kUnsupportedData,
            "the raster is a picture in colours (" + count +
                " bands), heights are needed; where its colours encode heights, decode them: "
                "gdal_calc.py -A IN --A_band=1 -B IN --B_band=2 -C IN --C_band=3 --outfile=OUT "
                "--type=Float32 --calc=\"A*6553.6+B*25.6+C*0.1-10000\" (Mapbox terrain-RGB) or "
                "--calc=\"A*256.0+B+C/256.0-32768\" (Terrarium)",
            "several-bands"};
  }
  // Without the mask its cells would become ground. By default GDAL 3.6 keeps a mask beside.
  const bool masked = (GDALGetMaskFlags(GDALGetRasterBand(dataset, 1)) & GMF_PER_DATASET) != 0;
  std::string mask;
  if (!bands.alpha.empty()) mask = " -mask " + std::to_string(bands.alpha.front());
  if (masked || !mask.empty()) mask += " --config GDAL_TIFF_INTERNAL_MASK YES";
  return {
      ErrorCode::kUnsupportedData,
      "the raster has " + count + " bands" +
          (bands.alpha.empty() ? std::string()
                               : " (band " + std::to_string(bands.alpha.front()) + " is alpha)") +
          ", one of heights is needed; take that one out, for example the first: "
          "gdal_translate -b 1" +
          mask + " IN OUT",
      "several-bands"};
}

// GDAL makes a colour table of its own for one-bit TIFFs that have none.
bool IsPicture(GDALRasterBandH band, TiffFile* tiff) {
  constexpr std::int64_t kPalette = 3;
  if (tiff != nullptr && tiff->Integer(0, TiffTag::kPhotometric, kPalette) != kPalette) {
    return false;
  }
  return GDALGetRasterColorTable(band) != nullptr && GDALGetRasterDataType(band) == GDT_Byte;
}

}  // namespace

Result<HeightBand> FindHeightBand(void* dataset, TiffFile* tiff) {
  const Bands bands = Survey(dataset);
  if (bands.count == 0) {
    return Error{ErrorCode::kUnsupportedData, "the raster has no band", "not-a-raster"};
  }
  const bool beside_alpha = bands.count == 2 && bands.alpha.size() == 1;
  if (bands.count > 1 && !beside_alpha) return SeveralBands(dataset, bands);
  HeightBand found;
  if (beside_alpha) {
    found.number = 3 - bands.alpha.front();
    found.alpha = GDALGetRasterBand(dataset, bands.alpha.front());
  }
  found.heights = GDALGetRasterBand(dataset, found.number);
  if (IsPicture(found.heights, tiff)) {
    return Error{ErrorCode::kUnsupportedData,
                 "the band is a picture of bytes with a colour table, heights are needed; where "
                 "the bytes are heights, take them out of their colours with gdal_calc.py -A IN "
                 "--calc=A --type=Int16 --outfile=OUT",
                 "unsupported-type"};
  }
  return found;
}

}  // namespace farhorizon
