#include "service/handlers/echo_inputs.h"

#include <algorithm>
#include <utility>
#include <vector>

#include "core/io/base64.h"
#include "service/echo_task.h"
#include "service/handlers/execute_request.h"
#include "service/handlers/http_message.h"

namespace farhorizon {

namespace {

using nlohmann::json;
using nlohmann::ordered_json;

constexpr int kLongestPause = 60;

Error InvalidEchoInput(const std::string& name, const std::string& expected) {
  return {ErrorCode::kInvalidArgument, "the input " + name + " must be " + expected,
          "invalid-parameter"};
}

// What an input stands for as an output.
using Echo = Result<EchoOutput> (*)(const std::string& name, const json& given);

Result<EchoOutput> EchoText(const std::string& name, const json& given) {
  Result<GivenInput> input = ReadInput(name, given);
  if (!input) return std::move(input.error());
  if (!input->value.is_string()) return InvalidEchoInput(name, "a text");
  return EchoOutput{name, "text/plain", input->value.get<std::string>()};
}

Result<EchoOutput> EchoNumbers(const std::string& name, const json& given) {
  Result<json> value = ReadValue(name, given);
  if (!value) return std::move(value.error());
  const auto whole = [](const json& one) { return one.is_number_integer(); };
  if (!value->is_array() || !std::all_of(value->begin(), value->end(), whole)) {
    return InvalidEchoInput(name, "a list of whole numbers");
  }
  return EchoOutput{name, "application/json", value->dump()};
}

// An object with a member `value` that is no object is a value by itself: it has no format.
Result<EchoOutput> EchoObject(const std::string& name, const json& given) {
  Result<GivenInput> input = ReadInput(name, given);
  if (!input) return std::move(input.error());
  if (!given.is_object()) return InvalidEchoInput(name, "an object");
  return EchoOutput{name, "application/json",
                    (input->value.is_object() ? input->value : given).dump()};
}

Result<EchoOutput> EchoBox(const std::string& name, const json& given) {
  Result<GivenInput> input = ReadInput(name, given);
  if (!input) return std::move(input.error());
  const json& box = input->value;
  const auto number = [](const json& one) { return one.is_number(); };
  const bool whole = box.is_object() && box.contains("bbox") && box["bbox"].is_array() &&
                     (box["bbox"].size() == 4 || box["bbox"].size() == 6) &&
                     std::all_of(box["bbox"].begin(), box["bbox"].end(), number) &&
                     box.value("crs", json("")).is_string();
  if (!whole)
    return InvalidEchoInput(name, "an object with a bbox of 4 or 6 numbers, and perhaps a crs");
  return EchoOutput{name, "application/json", box.dump()};
}

Result<EchoOutput> EchoImage(const std::string& name, const json& given) {
  Result<GivenInput> input = ReadInput(name, given);
  if (!input) return std::move(input.error());
  const bool tiff = input->media_type.empty() || MediaTypeIn(input->media_type) == "image/tiff";
  const bool base64 = input->encoding.empty() || input->encoding == "base64";
  std::string bytes;
  Base64Decoder decoder;
  if (!tiff || !base64 || !input->value.is_string() ||
      !decoder.Feed(input->value.get_ref<const std::string&>(), bytes) || !decoder.MayEnd()) {
    return InvalidEchoInput(name, "image/tiff in base64");
  }
  return EchoOutput{name, "image/tiff", input->value.get<std::string>(), true};
}

struct EchoInput {
  const char* name;
  const char* title;
  ordered_json schema;
  Echo echo;  // nullptr: it is not given back
};

const std::vector<EchoInput>& Inputs() {
  static const std::vector<EchoInput> inputs = {
      {"text", "A text", {{"type", "string"}}, EchoText},
      {"pause",
       "Seconds to wait before the answer",
       {{"type", "integer"}, {"minimum", 0}, {"maximum", kLongestPause}, {"default", 0}},
       nullptr},
      {"numbers",
       "Whole numbers",
       {{"type", "array"}, {"items", {{"type", "integer"}}}},
       EchoNumbers},
      {"object", "Any object", {{"type", "object"}}, EchoObject},
      {"box",
       "A bounding box",
       {{"allOf",
         {{{"format", "ogc-bbox"}},
          {{"$ref",
            "https://schemas.opengis.net/ogcapi/processes/part1/1.0/openapi/schemas/bbox.yaml"}}}}},
       EchoBox},
      {"image",
       "A picture",
       {{"type", "string"}, {"contentEncoding", "base64"}, {"contentMediaType", "image/tiff"}},
       EchoImage}};
  return inputs;
}

const EchoInput* FindInput(const std::string& name) {
  const auto found = std::find_if(Inputs().begin(), Inputs().end(),
                                  [&](const EchoInput& one) { return one.name == name; });
  return found == Inputs().end() ? nullptr : &*found;
}

Result<int> PauseOf(const json& given) {
  Result<GivenInput> input = ReadInput("pause", given);
  if (!input) return std::move(input.error());
  const json& value = input->value;
  if (!value.is_number_integer() || value < 0 || value > kLongestPause) {
    return InvalidEchoInput("pause", "a whole number from 0 to " + std::to_string(kLongestPause));
  }
  return value.get<int>();
}

}  // namespace

ordered_json EchoInputs() {
  ordered_json described = ordered_json::object();
  for (const EchoInput& input : Inputs()) {
    described[input.name] = {{"title", input.title}, {"minOccurs", 0}, {"schema", input.schema}};
  }
  return described;
}

ordered_json EchoOutputs() {
  ordered_json described = ordered_json::object();
  for (const EchoInput& input : Inputs()) {
    if (input.echo == nullptr) continue;
    described[input.name] = {{"title", input.title}, {"schema", input.schema}};
  }
  return described;
}

Result<std::string> EchoTaskOf(const json& inputs) {
  EchoTask task;
  for (const auto& [name, given] : inputs.items()) {
    const EchoInput* input = FindInput(name);
    if (input == nullptr) {
      return Error{ErrorCode::kInvalidArgument,
                   "echo has no input \"" + name.substr(0, 100) + "\"; its description lists all",
                   "invalid-parameter"};
    }
    if (input->echo == nullptr) {
      Result<int> pause = PauseOf(given);
      if (!pause) return std::move(pause.error());
      task.pause_seconds = *pause;
      continue;
    }
    Result<EchoOutput> output = input->echo(name, given);
    if (!output) return std::move(output.error());
    task.outputs.push_back(*std::move(output));
  }
  return WriteEchoTask(task);
}

}  // namespace farhorizon
