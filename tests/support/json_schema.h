#pragma once

#include <algorithm>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

namespace farhorizon {

/// Where a value breaks a schema. Knows what proto/schemas use: type, required, properties,
/// additionalProperties, propertyNames, items, enum, const, bounds, if and else; $ref and oneOf are
/// left out.
class SchemaCheck {
 public:
  /// closed: whether a property that the schema does not name is an offence.
  void Look(const nlohmann::json& value, const nlohmann::json& schema, const std::string& path,
            bool closed = true) {
    if (schema.contains("type") && !IsOneOf(value, schema["type"])) {
      Offend(path, "is no " + schema["type"].dump());
      return;
    }
    if (value.is_null()) return;
    if (schema.contains("const") && schema["const"] != value) Offend(path, "const");
    if (schema.contains("enum") &&
        std::find(schema["enum"].begin(), schema["enum"].end(), value) == schema["enum"].end()) {
      Offend(path, "enum");
    }
    if (value.is_number() && ((schema.contains("minimum") && value < schema["minimum"]) ||
                              (schema.contains("maximum") && value > schema["maximum"]))) {
      Offend(path, "out of bounds");
    }
    if (schema.contains("if") && schema.contains("else")) {
      SchemaCheck condition;
      condition.Look(value, schema["if"], path, false);
      if (!condition.offences().empty()) Look(value, schema["else"], path, false);
    }
    if (value.is_object()) LookIntoObject(value, schema, path, closed);
    if (value.is_array()) LookIntoArray(value, schema, path);
  }
  [[nodiscard]] const std::vector<std::string>& offences() const { return offences_; }

 private:
  // types: a name of a type, or an array of names.
  static bool IsOneOf(const nlohmann::json& value, const nlohmann::json& types) {
    if (types.is_string()) return IsA(value, types);
    return std::any_of(types.begin(), types.end(),
                       [&value](const nlohmann::json& type) { return IsA(value, type); });
  }
  static bool IsA(const nlohmann::json& value, const std::string& type) {
    return (type == "null" && value.is_null()) || (type == "object" && value.is_object()) ||
           (type == "array" && value.is_array()) || (type == "string" && value.is_string()) ||
           (type == "boolean" && value.is_boolean()) ||
           (type == "integer" && value.is_number_integer()) ||
           (type == "number" && value.is_number());
  }

  void LookIntoObject(const nlohmann::json& value, const nlohmann::json& schema,
                      const std::string& path, bool closed) {
    for (const auto& name : schema.value("required", nlohmann::json::array())) {
      if (!value.contains(name)) Offend(path, "lacks " + name.get<std::string>());
    }
    const auto properties = schema.value("properties", nlohmann::json::object());
    for (const auto& [name, member] : value.items()) {
      std::string deeper = path;
      deeper.append(".").append(name);
      if (schema.contains("propertyNames")) Look(name, schema["propertyNames"], deeper);
      if (properties.contains(name)) {
        Look(member, properties[name], deeper);
      } else if (schema.contains("additionalProperties")) {
        Look(member, schema["additionalProperties"], deeper);
      } else if (closed && !properties.empty()) {
        Offend(deeper, "the schema does not know it");
      }
    }
  }

  void LookIntoArray(const nlohmann::json& value, const nlohmann::json& schema,
                     const std::string& path) {
    if (value.size() < schema.value("minItems", std::size_t{0})) Offend(path, "too few");
    const auto items = schema.value("items", nlohmann::json::object());
    for (const auto& item : value) Look(item, items, path + "[]");
  }

  void Offend(const std::string& path, const std::string& why) {
    std::string& offence = offences_.emplace_back(path);
    offence.append(": ").append(why);
  }

  std::vector<std::string> offences_;
};

/// Where `value` breaks `schema`, as "path: why"; empty where it does not. A property that the
/// schema does not name is an offence too: what is answered has to be written.
inline std::vector<std::string> SchemaOffences(const nlohmann::json& value,
                                               const nlohmann::json& schema) {
  SchemaCheck check;
  check.Look(value, schema, "$");
  return check.offences();
}

}  // namespace farhorizon
