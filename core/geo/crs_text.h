#pragma once

#include <string>

#include "core/base/result.h"

namespace farhorizon {

/// What a text is to name.
enum class CrsRole {
  kMap,     ///< the reference system of a DEM, with or without heights
  kHeights  ///< a vertical datum
};

/// What `text` lacks to be read by PROJ, put right: a number alone becomes EPSG's code of that
/// number, "EPSG 4326" gets its colon, "EPSG:4326,EPSG:5773" and "EPSG:4326 5773" their plus,
/// "+init=epsg:4326" its colon form (the file that it would name holds the same systems), and a
/// PROJ string "+type=crs", which GDAL does not ask for. Any other text stays as it is.
std::string CompletedCrsText(const std::string& text);

/// Checks that `text` is safe to pass to PROJ, which opens the files and URLs that a definition
/// names (init files, grids, pipelines). Definitions come from files and requests of unknown
/// origin.
/// Errors: kUnsupportedData, kind "no-crs", for an empty text; kind "unknown-crs" for a URL, a
///   path, a pipeline, a definition that names grids, or one of more than 64 KiB. The remedy is
///   that of `role`.
Status CheckCrsText(const std::string& text, CrsRole role = CrsRole::kMap);

/// "reference system "text"", or "vertical datum "text"", cut to 60 bytes, without line breaks.
std::string ShownCrsText(const std::string& text, CrsRole role);
/// What to give instead of a text that cannot be taken, after a semicolon.
const char* RemedyFor(CrsRole role);

}  // namespace farhorizon
