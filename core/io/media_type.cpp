#include "core/io/media_type.h"

#include <filesystem>
#include <string_view>
#include <utility>

namespace farhorizon {

std::string MediaTypeOf(const std::string& name) {
  static constexpr std::pair<std::string_view, std::string_view> kTypes[] = {
      {".glb", "model/gltf-binary"},
      {".drc", "application/vnd.google.draco"},
      {".terrain", "application/vnd.quantized-mesh"},
      {".geojson", "application/geo+json"},
      {".json", "application/json"},
      {".html", "text/html"},
      {".fgb", "application/vnd.flatgeobuf"},
      {".gpkg", "application/geopackage+sqlite3"},
      {".svg", "image/svg+xml"},
      {".tif", "image/tiff; application=geotiff"},
      {".tiff", "image/tiff; application=geotiff"}};
  const std::string ending = std::filesystem::path(name).extension().string();
  for (const auto& [known, type] : kTypes) {
    if (ending == known) return std::string(type);
  }
  return "application/octet-stream";
}

}  // namespace farhorizon
