#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <nlohmann/json.hpp>

#include "service/handlers/handler_context.h"

namespace farhorizon {

/// The names of the processes that are offered.
std::vector<std::string> ProcessNames(const HandlerContext& context);
/// Whether this is one of them.
bool IsOffered(const HandlerContext& context, std::string_view process);

/// What OGC API - Processes calls a process summary. Requires: there is a process of this name.
nlohmann::ordered_json ProcessSummary(const std::string& process, const std::string& base);
/// The same, with inputs and outputs: a process description.
nlohmann::ordered_json ProcessDescription(const std::string& process, const std::string& base);

/// Whether the process may have an output of this name.
bool MayHaveOutput(std::string_view process, std::string_view output);

}  // namespace farhorizon
