#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace farhorizon {

/// A tag of a TIFF directory: numbers of TIFF's type (3 short, 4 long, 12 double), or text (2).
struct RawTag {
  std::uint16_t tag = 0;
  std::uint16_t type = 3;
  std::vector<double> numbers = {};
  std::string text = {};
};

/// One image of a TIFF, tag by tag: what GDAL's own writer does not make.
struct RawImage {
  int columns = 3;
  int rows = 2;
  int bits = 16;
  int format = 1;                    ///< SampleFormat; 0 leaves the tag out
  std::vector<double> samples = {};  ///< integers, of any number of bits
  std::vector<RawTag> more = {};
};

/// A TIFF of `images`, each in one strip, and each but masks and the like on EPSG:32610 with cells
/// of 30 m. big_tiff: version 43, with places of 8 bytes.
std::string RawTiff(const std::vector<RawImage>& images, bool big_endian = false,
                    bool big_tiff = false);

}  // namespace farhorizon
