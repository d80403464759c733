#pragma once

#include <cstdint>
#include <vector>

#include "core/base/result.h"
#include "core/io/dem/tiff/tiff_file.h"

namespace farhorizon {

/// A rectangle of posts: [first_column, end_column) x [first_row, end_row).
struct PostRectangle {
  std::int64_t first_column = 0;
  std::int64_t first_row = 0;
  std::int64_t end_column = 0;
  std::int64_t end_row = 0;
};

/// The strips or tiles that a TIFF leaves out.
struct AbsentBlocks {
  std::vector<PostRectangle> places;
  std::int64_t blocks = 0;  ///< of the whole band
};

/// Looks where the blocks of band number `band` (from 1) of the first image of `tiff` are stored.
///
/// A block with neither place nor bytes is left out: a sparse file, whose blocks mean the nodata
/// value or, without one, 0 (GDAL's definition, "Sparse files"). A block or the list of blocks
/// beyond the end of the file means that the file was cut short.
/// Errors: kUnsupportedData, kind "truncated". Cost: O(blocks).
Result<AbsentBlocks> FindAbsentBlocks(TiffFile& tiff, int band);

}  // namespace farhorizon
