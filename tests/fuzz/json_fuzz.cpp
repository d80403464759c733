// libFuzzer's target: JSON that clients send. An accepted document is within its depth and is the
// same after it is written and read again; parameters come out of it, or an error.
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <iostream>
#include <string>

#include "service/handlers/json_parameters.h"
#include "service/strict_json.h"

namespace {

constexpr int kMaxDepth = 64;

int DepthOf(const nlohmann::json& value) {
  if (!value.is_structured()) return 0;
  int deepest = 0;
  for (const auto& element : value) deepest = std::max(deepest, DepthOf(element));
  return deepest + 1;
}

void Require(bool holds, const char* what) {
  if (holds) return;
  std::cerr << "offence: " << what << std::endl;
  std::abort();
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string text(data, data + size);
  const auto document = farhorizon::ParseStrictJson(text);
  const auto parameters = farhorizon::ParametersOfJson(text);
  if (!document) {
    Require(!parameters, "no parameters come of broken JSON");
    return 0;
  }
  Require(DepthOf(*document) <= kMaxDepth, "the depth is bounded");
  const auto again = farhorizon::ParseStrictJson(document->dump());
  Require(again && *again == *document, "a document that is written again is the same");
  Require(!parameters || document->is_object(), "parameters come of objects");
  return 0;
}
