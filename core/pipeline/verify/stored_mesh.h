#pragma once

#include <cstdint>
#include <filesystem>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "core/io/draco_mesh.h"
#include "core/pipeline/verify/claims.h"

namespace farhorizon {

/// A vertex that is not near any post of the DEM stands for none.
inline constexpr std::uint32_t kNoPost = std::numeric_limits<std::uint32_t>::max();

/// The bytes of a file; nullopt, and a claim that is false, where it cannot be read.
std::optional<std::vector<std::uint8_t>> LoadBytes(const std::filesystem::path& path,
                                                   Claims& claims);

/// Claims that the bitstream in file `name` decodes.
std::optional<DecodedMesh> DecodeStored(const std::string& name,
                                        const std::vector<std::uint8_t>& bytes, Claims& claims);

}  // namespace farhorizon
