#pragma once

#include <cstdint>
#include <optional>
#include <span>

#include "core/io/mesh_files/file_mesh.h"

namespace farhorizon {

/// Decodes a Draco mesh of anyone: the attribute with the unique id `position`, or the first one of
/// positions. In the latter case, where its metadata name a lattice (core/io/draco_mesh.h), points
/// are in metres of the tile's frame, and `frame` says so; within a glTF the node's matrix places.
/// Errors: "bad-mesh-file", also for bitstreams older than 2.2; "mesh-too-large", before anything
///   is decoded.
Result<FileMesh> ReadDracoMesh(std::span<const std::uint8_t> bytes,
                               std::optional<std::uint32_t> position, const MeshLimits& limits);

}  // namespace farhorizon
