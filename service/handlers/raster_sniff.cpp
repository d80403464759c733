#include "service/handlers/raster_sniff.h"

#include "core/io/file_kind/file_kind.h"

namespace farhorizon {

Status CheckUpload(std::string_view beginning, std::int64_t bytes, std::string_view filename) {
  const FileFacts file = {beginning, bytes, filename};
  if (KindOfFile(file) != FileKind::kOther) return Ok{};
  return UnreadFile(file, "the DEM", "");
}

}  // namespace farhorizon
