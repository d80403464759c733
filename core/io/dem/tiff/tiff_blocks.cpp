#include "core/io/dem/tiff/tiff_blocks.h"

#include <algorithm>
#include <string>

#include "core/io/dem/complete_raster.h"

namespace farhorizon {

namespace {

// The grid of blocks, as the tags say. GDAL's own may be finer: it splits long strips.
struct BlockGrid {
  bool tiled = false;
  std::int64_t columns = 0;  // of posts
  std::int64_t rows = 0;
  std::int64_t width = 0;  // of a block
  std::int64_t height = 0;
  std::int64_t across = 0;  // blocks
  std::int64_t down = 0;
};

BlockGrid ReadBlockGrid(TiffFile& tiff) {
  const auto number = [&](TiffTag tag, std::int64_t otherwise) {
    return std::max<std::int64_t>(1, tiff.Integer(0, tag, otherwise));
  };
  BlockGrid grid;
  grid.tiled = tiff.Has(0, TiffTag::kTileOffsets);
  grid.columns = number(TiffTag::kColumns, 1);
  grid.rows = number(TiffTag::kRows, 1);
  grid.width = grid.tiled ? number(TiffTag::kTileWidth, grid.columns) : grid.columns;
  grid.height = grid.tiled ? number(TiffTag::kTileLength, grid.rows)
                           : std::min(number(TiffTag::kRowsPerStrip, grid.rows), grid.rows);
  grid.across = (grid.columns + grid.width - 1) / grid.width;
  grid.down = (grid.rows + grid.height - 1) / grid.height;
  return grid;
}

}  // namespace

Result<AbsentBlocks> FindAbsentBlocks(TiffFile& tiff, int band) {
  const BlockGrid grid = ReadBlockGrid(tiff);
  AbsentBlocks absent;
  absent.blocks = grid.across * grid.down;
  // Bands in planes of their own have their blocks one after another.
  const bool planes = tiff.Integer(0, TiffTag::kPlanarConfiguration, 1) == 2;
  const auto first = static_cast<std::size_t>(planes ? absent.blocks * (band - 1) : 0);
  const std::size_t end = first + static_cast<std::size_t>(absent.blocks);
  const std::vector<double> offsets =
      tiff.Numbers(0, grid.tiled ? TiffTag::kTileOffsets : TiffTag::kStripOffsets, end);
  const std::vector<double> bytes =
      tiff.Numbers(0, grid.tiled ? TiffTag::kTileByteCounts : TiffTag::kStripByteCounts, end);
  if (offsets.size() < end) return Truncated("the list of its blocks is missing");

  const auto file_bytes = static_cast<double>(tiff.file_bytes());
  for (std::size_t i = first; i < end; ++i) {
    const std::int64_t x = static_cast<std::int64_t>(i - first) % grid.across;
    const std::int64_t y = static_cast<std::int64_t>(i - first) / grid.across;
    const double size = i < bytes.size() ? bytes[i] : 0;
    if (offsets[i] == 0 && size == 0) {
      absent.places.push_back({x * grid.width, y * grid.height,
                               std::min((x + 1) * grid.width, grid.columns),
                               std::min((y + 1) * grid.height, grid.rows)});
    } else if (offsets[i] == 0 || offsets[i] + size > file_bytes) {
      return Truncated("block (" + std::to_string(x) + ", " + std::to_string(y) +
                       ") lies beyond the end of the file");
    }
  }
  return absent;
}

}  // namespace farhorizon
