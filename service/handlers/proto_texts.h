#pragma once

#include <string_view>

namespace farhorizon {

/// The files of proto/ that the service answers with; the build puts their bytes into the program.
extern const std::string_view kOpenApiText;
extern const std::string_view kConformanceSchemaText;
extern const std::string_view kExecuteSchemaText;
extern const std::string_view kJobListSchemaText;
extern const std::string_view kLandingSchemaText;
extern const std::string_view kProblemSchemaText;
extern const std::string_view kProcessListSchemaText;
extern const std::string_view kProcessSchemaText;
extern const std::string_view kResultsSchemaText;
extern const std::string_view kStatusInfoSchemaText;
extern const std::string_view kUploadSchemaText;

}  // namespace farhorizon
