#pragma once

#include <string>

#include "core/base/result.h"

struct pj_ctx;  // PROJ's own name of PJ_CONTEXT

namespace farhorizon {

/// Makes a context of PROJ open nothing but the database and the grids in the folder of its
/// package: whatever the environment, home folders and /tmp hold, and whatever file a definition
/// names. It fetches nothing.
void SealContext(pj_ctx* context);

/// The folders in which Debian's packages have PROJ's database and grids, and GDAL's tables.
const char* ProjDataFolder();
const char* GdalDataFolder();

/// How a grid is had that is not installed: for messages, after the grid's name.
std::string WhereGridsGo();

/// The descriptor on which this process has the database open; -1 where it has not.
int ReferenceDataFd();

/// Checks that the database is there. Errors: kIo, kind "reference-data", with the remedy.
Status CheckReferenceData();

}  // namespace farhorizon
