#pragma once

#include <map>
#include <optional>
#include <string>
#include <string_view>

#include <nlohmann/json.hpp>

#include "core/pipeline/build_options.h"
#include "service/handlers/result_wishes.h"

namespace farhorizon {

/// The transmissions that are asked for by name, unset where none is; nullopt for all outputs.
using AskedOutputs = std::optional<std::map<std::string, std::optional<Transmission>>>;

/// The member `outputs` of an execute request.
/// Errors: kInvalidArgument "invalid-parameter" where the process has no such output, or none of
///   the media type that is asked for.
Result<AskedOutputs> ReadAskedOutputs(const nlohmann::json& request, std::string_view process);

/// Whether a job with these options may make each output of terrain-lod that is asked for: how many
/// levels there are and which of them is in parts depends on the DEM.
/// Errors: kInvalidArgument "invalid-parameter", naming the parameter that leaves the output out.
Status CheckOutputsOf(const ResultWishes& wishes, const BuildOptions& options);

}  // namespace farhorizon
