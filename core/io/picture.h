#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "core/base/result.h"

namespace farhorizon {

/// A picture in shades of grey. values: height x width, row-major, the topmost row first; 0 black.
struct GreyPicture {
  int width = 0;
  int height = 0;
  std::vector<std::uint8_t> values;
};

/// A picture in the colours of a palette. values: as in GreyPicture, each a place in `palette`.
/// palette: red, green, blue and opacity, 0 to 255; at most 256.
struct PalettePicture {
  int width = 0;
  int height = 0;
  std::vector<std::uint8_t> values;
  std::vector<std::array<std::uint8_t, 4>> palette;
};

/// The bytes of a JPEG file. quality: 10 to 95.
/// Errors: kIo. Requires: 1 <= width, height <= 65500.
Result<std::string> EncodeJpeg(const GreyPicture& picture, int quality);

/// The bytes of a PNG file. Errors: kIo. Requires: 1 <= width, height.
Result<std::string> EncodePng(const PalettePicture& picture);

}  // namespace farhorizon
