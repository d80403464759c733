#pragma once

#include <filesystem>
#include <vector>

#include "core/base/assumption.h"
#include "core/base/result.h"
#include "core/io/dem/height_band.h"
#include "core/io/dem/tiff/tiff_blocks.h"
#include "core/io/gdal_session.h"

namespace farhorizon {

/// Makes NaN of the cells of `values` (rows x columns of `band`) that a mask hides, whatever their
/// values: an internal mask of the dataset; an alpha band, where it is 0 (cells that it shows in
/// part are kept, and said); the TIFF FILE.msk beside the file at `path`, GDAL's name for a mask.
///
/// FILE.msk is opened as a TIFF and nothing else; one of another size hides nothing, and is said.
/// Errors: kUnsupportedData "truncated" where a mask cannot be read.
Status ApplyMasks(const HeightBand& band, const std::filesystem::path& path, GdalSession& session,
                  std::vector<double>& values, Assumptions& assumptions);

/// Makes NaN of the posts of `places` in `values`, rows of `columns` posts.
void HidePlaces(const std::vector<PostRectangle>& places, int columns, std::vector<double>& values);

}  // namespace farhorizon
