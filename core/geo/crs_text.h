#pragma once

#include <string>

#include "core/base/result.h"

namespace farhorizon {

/// Checks that `text` is safe to pass to PROJ, which opens the files and URLs that a definition
/// names (init files, grids, pipelines). Definitions come from files and requests of unknown
/// origin.
/// Errors: kUnsupportedData, kind "no-crs", for an empty text; kind "unknown-crs" for a URL, a
///   path, a pipeline, a definition that names grids, or one of more than 64 KiB.
Status CheckCrsText(const std::string& text);

}  // namespace farhorizon
