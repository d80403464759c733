#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string_view>

#include <nlohmann/json.hpp>

#include "core/base/result.h"

namespace farhorizon {

/// JSON of a mesh file. Members are asked for with at(), whose exceptions ReadGltf and ReadTiles
/// turn into errors.
using MeshJson = nlohmann::json;

/// Parses `text`. Errors: "bad-mesh-file" where it is no JSON, more than 64 deep (nlohmann's
/// destructor recurses), or longer than 64 MiB (numbers take eight times the memory).
Result<MeshJson> ParseMeshJson(std::string_view text);

/// A number from 0 to 2^53, without a fraction. Throws nlohmann::json::exception where `value` is
/// none: get<std::size_t>() would take -1 and 1e99, too.
std::uint64_t CountIn(const MeshJson& value);
/// The same for a member, `otherwise` where it is absent.
std::uint64_t CountOr(const MeshJson& object, const char* name, std::uint64_t otherwise);

/// The member of that name; nullptr where `object` has none.
const MeshJson* Member(const MeshJson& object, const char* name);

}  // namespace farhorizon
