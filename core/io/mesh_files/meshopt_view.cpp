// meshoptimizer's decoders are safe on bytes of unknown origin, but assert what they are called
// with: strides and counts are checked here, as the extension's specification has them.
#include "core/io/mesh_files/meshopt_view.h"

#include <algorithm>
#include <initializer_list>
#include <meshoptimizer.h>
#include <string>

#include "core/io/mesh_files/file_mesh.h"

namespace farhorizon {

namespace {

bool HasStride(const MeshoptView& view, std::initializer_list<std::uint64_t> strides) {
  return std::find(strides.begin(), strides.end(), view.stride) != strides.end();
}

bool IsSound(const MeshoptView& view) {
  if (view.mode == "ATTRIBUTES") {
    if (view.stride == 0 || view.stride % 4 != 0 || view.stride > 256) return false;
    if (view.filter == "OCTAHEDRAL") return HasStride(view, {4, 8});
    if (view.filter == "QUATERNION") return view.stride == 8;
    return view.filter == "NONE" || view.filter == "EXPONENTIAL";
  }
  if (view.filter != "NONE" || !HasStride(view, {2, 4})) return false;
  return view.mode == "INDICES" || (view.mode == "TRIANGLES" && view.count % 3 == 0);
}

}  // namespace

Result<std::vector<std::uint8_t>> DecodeMeshopt(std::span<const std::uint8_t> bytes,
                                                const MeshoptView& view) {
  if (!IsSound(view)) {
    return BadMeshFile("a view under EXT_meshopt_compression has a mode, filter or stride that " +
                       std::string("the extension does not know"));
  }
  std::vector<std::uint8_t> decoded(view.stride * view.count);
  const unsigned char* from = bytes.data();
  const int failure =
      view.mode == "ATTRIBUTES"
          ? meshopt_decodeVertexBuffer(decoded.data(), view.count, view.stride, from, bytes.size())
      : view.mode == "TRIANGLES"
          ? meshopt_decodeIndexBuffer(decoded.data(), view.count, view.stride, from, bytes.size())
          : meshopt_decodeIndexSequence(decoded.data(), view.count, view.stride, from,
                                        bytes.size());
  if (failure != 0) {
    return BadMeshFile("a view under EXT_meshopt_compression is damaged");
  }
  if (view.filter == "OCTAHEDRAL") {
    meshopt_decodeFilterOct(decoded.data(), view.count, view.stride);
  } else if (view.filter == "QUATERNION") {
    meshopt_decodeFilterQuat(decoded.data(), view.count, view.stride);
  } else if (view.filter == "EXPONENTIAL") {
    meshopt_decodeFilterExp(decoded.data(), view.count, view.stride);
  }
  return decoded;
}

}  // namespace farhorizon
