#pragma once

#include "core/base/result.h"

namespace farhorizon {

/// Makes PROJ open nothing but the database and the grids in the folder of its package, in this
/// process, for good: whatever the environment, home folders and /tmp hold, and whatever file a
/// definition names. Contexts made before this call are not changed; those of GDAL are made later.
/// Threads: safe; each call after the first has no effect.
void SealReferenceData();

/// The folders in which Debian's packages have PROJ's database and grids, and GDAL's tables.
const char* ProjDataFolder();
const char* GdalDataFolder();

/// Checks that the database is there. Errors: kIo, kind "reference-data", with the remedy.
Status CheckReferenceData();

}  // namespace farhorizon
