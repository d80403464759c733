#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "core/base/assumption.h"
#include "core/io/dem/place/reference_system.h"

namespace farhorizon {

/// The .prj beside a raster, in Esri's WKT or in Arc/Info's keywords.
///
/// crs: the reference system that it states; null where it states none that can be read.
struct PrjFile {
  std::string name;
  std::string text;
  CrsPtr crs;
};

/// The .prj beside the raster at `path`; nullopt where there is none. Of more than 64 KiB nothing
/// is read.
std::optional<PrjFile> FindPrjFile(const std::filesystem::path& path);

/// Says what of a .prj is not taken with its system: the unit of heights of its old form, and a
/// shift of heights.
void SayUnreadOf(const PrjFile& prj, Assumptions& assumptions);

/// Says where the .prj beside a raster with a system of its own, `own` (an OGRSpatialReferenceH),
/// says something else, or more.
void SayPassedOver(const PrjFile& prj, void* own, Assumptions& assumptions);

}  // namespace farhorizon
