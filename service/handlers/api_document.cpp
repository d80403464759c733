#include "service/handlers/api_document.h"

#include <algorithm>
#include <array>
#include <string_view>
#include <utility>

#include "core/base/result.h"
#include "service/handlers/proto_texts.h"

namespace farhorizon {

namespace {

using nlohmann::ordered_json;

constexpr std::string_view kReferenceInFiles = "schemas/";
constexpr std::string_view kReferenceInSchemas = "urn:farhorizon:schema:";
constexpr std::string_view kEnding = ".schema.json";

// A reference to a file of proto/schemas, or from one to another, as one within the document.
std::string InnerReference(std::string_view reference) {
  if (reference.starts_with(kReferenceInFiles)) {
    reference.remove_prefix(kReferenceInFiles.size());
    reference.remove_suffix(kEnding.size());
  } else if (reference.starts_with(kReferenceInSchemas)) {
    reference.remove_prefix(kReferenceInSchemas.size());
  } else {
    return std::string(reference);
  }
  return "#/components/schemas/" + std::string(reference);
}

void TurnReferencesInwards(ordered_json& node) {
  if (node.is_object() && node.contains("$ref") && node["$ref"].is_string()) {
    node["$ref"] = InnerReference(node["$ref"].get<std::string>());
  }
  if (!node.is_structured()) return;
  for (ordered_json& child : node) TurnReferencesInwards(child);
}

ordered_json ReadSource() {
  ordered_json document = ordered_json::parse(kOpenApiText);
  ordered_json& schemas = document["components"]["schemas"];
  for (const auto& [name, text] : std::initializer_list<std::pair<const char*, std::string_view>>{
           {"conformance", kConformanceSchemaText},
           {"execute", kExecuteSchemaText},
           {"job-list", kJobListSchemaText},
           {"landing", kLandingSchemaText},
           {"problem", kProblemSchemaText},
           {"process", kProcessSchemaText},
           {"process-list", kProcessListSchemaText},
           {"results", kResultsSchemaText},
           {"status-info", kStatusInfoSchemaText},
           {"upload", kUploadSchemaText}}) {
    ordered_json schema = ordered_json::parse(text);
    schema.erase("$id");
    schema.erase("$schema");
    schemas[name] = std::move(schema);
  }
  TurnReferencesInwards(document);
  return document;
}

const ordered_json& Source() {
  static const ordered_json document = ReadSource();
  return document;
}

// The members of such an object have names of the schema's author, not words of a schema.
bool HoldsNames(const std::string& word) {
  constexpr std::array<std::string_view, 7> kWords = {
      "properties", "schemas", "parameters", "paths", "responses", "headers", "content"};
  return std::find(kWords.begin(), kWords.end(), word) != kWords.end();
}

// In 3.0 a bound that is excluded is the bound and a flag beside it.
void SplitExclusiveBound(ordered_json& node, const char* exclusive, const char* inclusive) {
  if (!node.contains(exclusive) || !node[exclusive].is_number()) return;
  node[inclusive] = node[exclusive];
  node[exclusive] = true;
}

void SplitTypes(ordered_json& node) {
  if (!node.contains("type") || !node["type"].is_array()) return;
  const ordered_json types = node["type"];
  node.erase("type");
  node["anyOf"] = ordered_json::array();
  for (const ordered_json& type : types) {
    ordered_json one = {{"type", type}};
    if (type == "array") one["items"] = ordered_json::object();
    node["anyOf"].push_back(std::move(one));
  }
}

void Lower(ordered_json& node) {
  if (node.is_array()) {
    for (ordered_json& child : node) Lower(child);
  }
  if (!node.is_object()) return;
  for (const char* word : {"propertyNames", "if", "then", "else"}) node.erase(word);
  if (node.contains("const")) {
    node["enum"] = ordered_json::array({node["const"]});
    node.erase("const");
  }
  SplitExclusiveBound(node, "exclusiveMinimum", "minimum");
  SplitExclusiveBound(node, "exclusiveMaximum", "maximum");
  SplitTypes(node);
  for (const auto& [word, child] : node.items()) {
    if (HoldsNames(word) && child.is_object()) {
      for (ordered_json& named : child) Lower(named);
    } else if (word != "enum" && word != "default" && word != "example") {
      Lower(child);
    }
  }
}

// Within a document of the API; process descriptions do have these words.
void LowerContentWords(ordered_json& node) {
  if (node.is_object() && node.contains("contentEncoding") && node["contentEncoding"].is_string()) {
    node["format"] = node["contentEncoding"] == "base64" ? "byte" : "binary";
    node.erase("contentEncoding");
    node.erase("contentMediaType");
  }
  if (!node.is_structured()) return;
  for (ordered_json& child : node) LowerContentWords(child);
}

}  // namespace

ordered_json ApiDocument(OpenApiVersion version, const std::string& base) {
  ordered_json document = Source();
  document["servers"] = ordered_json::array({{{"url", base}}});
  if (version == OpenApiVersion::k31) return document;
  document["openapi"] = "3.0.3";
  ordered_json& info = document["info"];
  info["description"] = info["summary"];
  info.erase("summary");
  info["license"].erase("identifier");
  for (const char* part : {"paths", "components"}) {
    for (ordered_json& child : document[part]) {
      for (ordered_json& named : child) Lower(named);
    }
  }
  LowerContentWords(document["components"]["schemas"]);
  return document;
}

const ordered_json& JobParameters() { return Source()["paths"]["/jobs"]["post"]["parameters"]; }

ordered_json SchemaOf30(const ordered_json& schema) {
  ordered_json lowered = schema;
  Lower(lowered);
  return lowered;
}

}  // namespace farhorizon
