#include "service/handlers/api_document.h"

#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace farhorizon {
namespace {

using nlohmann::ordered_json;

// Every reference in a document.
void References(const ordered_json& node, std::vector<std::string>& found) {
  if (node.is_object() && node.contains("$ref")) found.push_back(node["$ref"].get<std::string>());
  if (!node.is_structured()) return;
  for (const ordered_json& child : node) References(child, found);
}

TEST(ApiDocument, HasAllThatItRefersTo) {
  for (const OpenApiVersion version : {OpenApiVersion::k30, OpenApiVersion::k31}) {
    const ordered_json document = ApiDocument(version, "http://x");
    EXPECT_EQ(document["servers"][0]["url"], "http://x");
    std::vector<std::string> references;
    References(document, references);
    EXPECT_GE(references.size(), 20U);
    for (const std::string& reference : references) {
      ASSERT_EQ(reference.front(), '#') << reference;
      EXPECT_TRUE(document.contains(ordered_json::json_pointer(reference.substr(1)))) << reference;
    }
  }
  EXPECT_EQ(ApiDocument(OpenApiVersion::k31, "")["openapi"], "3.1.0");
  EXPECT_EQ(ApiDocument(OpenApiVersion::k30, "")["openapi"], "3.0.3");
}

TEST(SchemaOf30, SaysInItsWordsWhatTheSchemaSays) {
  const ordered_json schema = ordered_json::parse(
      R"({"type": "object", "if": {}, "properties": {"const": {"const": 3}, "if": {"enum": [1]},
          "n": {"type": ["number", "array"]}, "m": {"exclusiveMinimum": 0, "type": "number"}}})");
  EXPECT_EQ(SchemaOf30(schema),
            ordered_json::parse(
                R"({"type": "object", "properties": {"const": {"enum": [3]}, "if": {"enum": [1]},
          "n": {"anyOf": [{"type": "number"}, {"type": "array", "items": {}}]},
          "m": {"exclusiveMinimum": true, "type": "number", "minimum": 0}}})"));
}

}  // namespace
}  // namespace farhorizon
