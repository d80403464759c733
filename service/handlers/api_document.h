#pragma once

#include <string>

#include <nlohmann/json.hpp>

namespace farhorizon {

enum class OpenApiVersion { k30, k31 };

/// proto/openapi.yaml, with the schemas beside it put in and `base` as its server; for OpenAPI 3.0
/// in the words of that, which lack some of what 3.1 says.
nlohmann::ordered_json ApiDocument(OpenApiVersion version, const std::string& base);

/// The parameters of POST /jobs as proto/openapi.yaml has them: all that a job can be asked for.
const nlohmann::ordered_json& JobParameters();

/// A JSON Schema in the dialect of OpenAPI 3.0, which is that of process descriptions.
nlohmann::ordered_json SchemaOf30(const nlohmann::ordered_json& schema);

}  // namespace farhorizon
