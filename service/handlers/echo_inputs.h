#pragma once

#include <string>

#include <nlohmann/json.hpp>

#include "core/base/result.h"

namespace farhorizon {

/// The inputs of the process echo as its description has them. The first is a text, as the test
/// suite of OGC API - Processes expects.
nlohmann::ordered_json EchoInputs();
/// Its outputs: one for each input but `pause`, under the same name.
nlohmann::ordered_json EchoOutputs();

/// The input file of an echo's worker, which gives these inputs back.
/// Errors: kInvalidArgument "invalid-parameter", "href-not-allowed".
Result<std::string> EchoTaskOf(const nlohmann::json& inputs);

}  // namespace farhorizon
