#include "service/handlers/json_parameters.h"

#include <optional>

#include "service/handlers/problem.h"
#include "service/strict_json.h"

namespace farhorizon {

namespace {

// A number, a boolean or a string as the text of a parameter.
std::optional<std::string> ScalarText(const nlohmann::json& value) {
  if (value.is_string()) return value.get<std::string>();
  if (value.is_number() || value.is_boolean()) return value.dump();
  return std::nullopt;
}

}  // namespace

Result<Parameters> ParametersOfJson(const std::string& text) {
  Result<nlohmann::json> document = ParseStrictJson(text);
  if (!document) return std::move(document.error());
  return ParametersOf(*document);
}

Result<Parameters> ParametersOf(const nlohmann::json& document) {
  if (!document.is_object()) return InvalidParameter("the parameters must be a JSON object");
  Parameters parameters;
  for (const auto& [name, value] : document.items()) {
    std::optional<std::string> joined = ScalarText(value);
    if (value.is_array()) {
      joined.emplace();
      for (const auto& element : value) {
        const std::optional<std::string> part = ScalarText(element);
        if (!part) return InvalidParameter("the parameter " + name + " must list numbers or texts");
        joined->append(",").append(*part);
      }
      joined->erase(0, 1);
    }
    if (!joined)
      return InvalidParameter("the parameter " + name + " must be a number, a text or a list");
    parameters.emplace(name, *joined);
  }
  return parameters;
}

}  // namespace farhorizon
