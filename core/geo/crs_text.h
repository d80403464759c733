#pragma once

#include <string>

#include "core/base/result.h"

namespace farhorizon {

/// Whether `text` may be shown to PROJ at all. PROJ opens files and URLs that a definition names
/// (init files, grids, pipelines), and definitions come from strangers' files and requests.
/// Errors: kUnsupportedData "no-crs" empty; "unknown-crs" a URL, a path, a pipeline, a definition
///   that names grids, or one of more than 64 KiB.
Status CheckCrsText(const std::string& text);

}  // namespace farhorizon
