#pragma once

#include "core/base/result.h"
#include "core/io/dem/tiff/tiff_file.h"

namespace farhorizon {

/// The bands of a raster that the reader uses: GDALRasterBandHs.
struct HeightBand {
  void* heights = nullptr;
  void* alpha = nullptr;  ///< nullptr where there is none
  int number = 1;         ///< of `heights`
};

/// Finds the band with the heights of `dataset` (a GDALDatasetH): its only one, or the one beside
/// an alpha band. A colour table over integers of more than 8 bits is a way to draw heights (GRASS
/// writes them so), over bytes it makes a picture or a map of classes.
/// tiff: nullptr for other formats.
/// Errors: kUnsupportedData, kinds "not-a-raster" no band, "several-bands" with what takes one out,
///   "unsupported-type" pictures.
Result<HeightBand> FindHeightBand(void* dataset, TiffFile* tiff);

}  // namespace farhorizon
