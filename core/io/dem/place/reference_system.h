#pragma once

#include <memory>
#include <string>

#include "core/base/result.h"

namespace farhorizon {

/// Owns an OGRSpatialReferenceH.
struct ReleaseCrs {
  void operator()(void* crs) const;
};
using CrsPtr = std::unique_ptr<void, ReleaseCrs>;

/// A reference system (an OGRSpatialReferenceH) as PROJ reads it: its code, or WKT.
/// Errors: kUnsupportedData, kind "no-crs".
Result<std::string> NameOfCrs(void* crs);

/// Whether two reference systems (OGRSpatialReferenceH) are the same but for the order of their
/// axes.
bool SameCrs(void* a, void* b);
/// Whether they are so without their vertical systems.
bool SameHorizontally(void* a, void* b);

}  // namespace farhorizon
