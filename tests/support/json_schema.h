#pragma once

#include <algorithm>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

namespace farhorizon {

/// Where `value` breaks `schema`, as "path: why"; empty where it does not. Knows what proto/schemas
/// use: type, required, properties, additionalProperties, items, enum, const, bounds, $ref left out.
/// A property that the schema does not name is an offence too: what is answered has to be written.
inline std::vector<std::string> SchemaOffences(const nlohmann::json& value,
                                               const nlohmann::json& schema,
                                               const std::string& path = "$") {
  std::vector<std::string> offences;
  const auto add = [&](const std::vector<std::string>& more) {
    offences.insert(offences.end(), more.begin(), more.end());
  };
  const std::string type = schema.value("type", "");
  const bool right =
      type.empty() || (type == "object" && value.is_object()) ||
      (type == "array" && value.is_array()) || (type == "string" && value.is_string()) ||
      (type == "boolean" && value.is_boolean()) ||
      (type == "integer" && value.is_number_integer()) || (type == "number" && value.is_number());
  if (!right) return {path + ": is no " + type};
  if (schema.contains("const") && schema["const"] != value) offences.push_back(path + ": const");
  if (schema.contains("enum") &&
      std::find(schema["enum"].begin(), schema["enum"].end(), value) == schema["enum"].end()) {
    offences.push_back(path + ": enum");
  }
  if (value.is_number() && ((schema.contains("minimum") && value < schema["minimum"]) ||
                            (schema.contains("maximum") && value > schema["maximum"]))) {
    offences.push_back(path + ": out of bounds");
  }
  if (value.is_object()) {
    for (const auto& name : schema.value("required", nlohmann::json::array())) {
      if (!value.contains(name)) offences.push_back(path + ": lacks " + name.get<std::string>());
    }
    const auto properties = schema.value("properties", nlohmann::json::object());
    for (const auto& [name, member] : value.items()) {
      if (properties.contains(name)) {
        add(SchemaOffences(member, properties[name], path + "." + name));
      } else if (schema.contains("additionalProperties")) {
        add(SchemaOffences(member, schema["additionalProperties"], path + "." + name));
      } else if (!properties.empty()) {
        offences.push_back(path + ": has " + name + ", which the schema does not know");
      }
    }
  }
  if (value.is_array()) {
    if (value.size() < schema.value("minItems", std::size_t{0})) {
      offences.push_back(path + ": too few");
    }
    const auto items = schema.value("items", nlohmann::json::object());
    for (const auto& item : value) add(SchemaOffences(item, items, path + "[]"));
  }
  return offences;
}

}  // namespace farhorizon
