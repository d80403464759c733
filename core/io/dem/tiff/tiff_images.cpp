#include "core/io/dem/tiff/tiff_images.h"

#include <optional>
#include <string>

namespace farhorizon {

namespace {

constexpr std::int64_t kReduced = 1;  // bits of NewSubfileType
constexpr std::int64_t kMask = 4;

std::int64_t SubfileType(TiffFile& tiff, std::size_t directory) {
  if (tiff.Has(directory, TiffTag::kNewSubfileType)) {
    return tiff.Integer(directory, TiffTag::kNewSubfileType, 0);
  }
  constexpr std::int64_t kOldReduced = 2;
  return tiff.Integer(directory, TiffTag::kSubfileType, 0) == kOldReduced ? kReduced : 0;
}

std::string Size(TiffFile& tiff, std::size_t directory) {
  return std::to_string(tiff.Integer(directory, TiffTag::kColumns, 0)) + " x " +
         std::to_string(tiff.Integer(directory, TiffTag::kRows, 0));
}

}  // namespace

void SayWhichImage(TiffFile& tiff, Assumptions& assumptions) {
  int images = 0;
  std::optional<std::size_t> largest;  // of the others
  for (std::size_t i = 0; i < tiff.size(); ++i) {
    if ((SubfileType(tiff, i) & (kReduced | kMask)) != 0) continue;
    ++images;
    if (i == 0) continue;
    if (!largest ||
        tiff.Integer(i, TiffTag::kColumns, 0) > tiff.Integer(*largest, TiffTag::kColumns, 0)) {
      largest = i;
    }
  }
  if (!largest) return;
  const bool reduced = SubfileType(tiff, 0) != 0;
  assumptions.push_back(
      {"tiff-images",
       "the file has " + std::to_string(images + (reduced ? 1 : 0)) +
           " images; the first was read (" + Size(tiff, 0) + " cells" +
           (reduced ? ", a reduced one by its tag" : "") + "); to read another, such as number " +
           std::to_string(*largest + 1) + " (" + Size(tiff, *largest) +
           "), take it out with gdal_translate GTIFF_DIR:" + std::to_string(*largest + 1) +
           ":IN OUT"});
}

}  // namespace farhorizon
