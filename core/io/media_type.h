#pragma once

#include <string>

namespace farhorizon {

/// The media type an artifact of this name is served as: "model/gltf-binary" for "lod0.glb";
/// "application/octet-stream" for an ending that is not known.
std::string MediaTypeOf(const std::string& name);

}  // namespace farhorizon
