#include "service/echo_task.h"

#include <utility>

#include <nlohmann/json.hpp>

namespace farhorizon {

using nlohmann::json;

std::string WriteEchoTask(const EchoTask& task) {
  json outputs = json::array();
  for (const EchoOutput& output : task.outputs) {
    outputs.push_back({{"name", output.name},
                       {"mediaType", output.media_type},
                       {"text", output.text},
                       {"base64", output.base64}});
  }
  return json{{"pause", task.pause_seconds}, {"outputs", std::move(outputs)}}.dump() + "\n";
}

Result<EchoTask> ReadEchoTask(const std::string& text) {
  try {
    const json object = json::parse(text);
    EchoTask task{object.at("pause").get<int>()};
    for (const json& one : object.at("outputs")) {
      task.outputs.push_back({one.at("name").get<std::string>(),
                              one.at("mediaType").get<std::string>(),
                              one.at("text").get<std::string>(), one.at("base64").get<bool>()});
    }
    return task;
  } catch (const json::exception& failure) {
    return Error{ErrorCode::kUnsupportedData, std::string("an echo's input: ") + failure.what()};
  }
}

}  // namespace farhorizon
