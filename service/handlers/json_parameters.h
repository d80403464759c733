#pragma once

#include <string>

#include <nlohmann/json.hpp>

#include "core/base/result.h"
#include "service/url_query.h"

namespace farhorizon {

/// The parameters in a form's part `params`: a JSON object whose values are numbers, booleans,
/// strings, or arrays of those, which become lists separated by commas.
/// Errors: kInvalidArgument "invalid-json", "invalid-parameter".
Result<Parameters> ParametersOfJson(const std::string& text);
/// The same of a document that has been parsed. Errors: kInvalidArgument "invalid-parameter".
Result<Parameters> ParametersOf(const nlohmann::json& document);

}  // namespace farhorizon
