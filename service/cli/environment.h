#pragma once

namespace farhorizon {

/// Removes every environment variable of this process that this program has no use for.
///
/// GDAL reads any of its several hundred options, and PROJ and GDAL their folders, from variables
/// that often have no prefix in common. None of them may decide what a result is.
/// Threads: the first call of main, before any other thread.
void KeepOnlyKnownEnvironment();

}  // namespace farhorizon
