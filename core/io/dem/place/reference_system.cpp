#include "core/io/dem/place/reference_system.h"

#include <cpl_conv.h>
#include <ogr_spatialref.h>
#include <ogr_srs_api.h>

namespace farhorizon {

void ReleaseCrs::operator()(void* crs) const { OSRRelease(crs); }

Result<std::string> NameOfCrs(void* crs) {
  const char* authority = OSRGetAuthorityName(crs, nullptr);
  const char* code = OSRGetAuthorityCode(crs, nullptr);
  if (authority != nullptr && code != nullptr) return std::string(authority) + ":" + code;
  const char* const format[] = {"FORMAT=WKT2_2019", "MULTILINE=NO", nullptr};
  char* text = nullptr;
  const OGRErr failure = OSRExportToWktEx(crs, &text, format);
  std::string wkt = text != nullptr ? text : "";
  CPLFree(text);
  if (failure != OGRERR_NONE || wkt.empty()) {
    return Error{ErrorCode::kUnsupportedData,
                 "the DEM's reference system cannot be read; name it with --crs", "no-crs"};
  }
  return wkt;
}

bool SameCrs(void* a, void* b) {
  const char* const options[] = {"CRITERION=EQUIVALENT_EXCEPT_AXIS_ORDER_GEOGCRS",
                                 "IGNORE_DATA_AXIS_TO_SRS_AXIS_MAPPING=YES", nullptr};
  return OSRIsSameEx(a, b, options) != 0;
}

bool SameHorizontally(void* a, void* b) {
  const CrsPtr plan_a(OSRClone(a));
  const CrsPtr plan_b(OSRClone(b));
  OGRSpatialReference::FromHandle(plan_a.get())->StripVertical();
  OGRSpatialReference::FromHandle(plan_b.get())->StripVertical();
  return SameCrs(plan_a.get(), plan_b.get());
}

}  // namespace farhorizon
