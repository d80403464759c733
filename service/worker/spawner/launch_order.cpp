#include "service/worker/spawner/launch_order.h"

#include <nlohmann/json.hpp>

namespace farhorizon {

namespace {

using nlohmann::json;

}  // namespace

std::string WriteOrder(const LaunchOrder& order) {
  const WorkerLimits& limits = order.limits;
  return json({{"program", order.program},
               {"probe", order.probe_only},
               {"directory", order.directory.string()},
               {"memoryBytes", limits.memory_bytes},
               {"cpuSeconds", limits.cpu_seconds},
               {"wallSeconds", limits.wall_seconds},
               {"fileBytes", limits.file_bytes},
               {"openFiles", limits.open_files}})
      .dump(-1, ' ', false, json::error_handler_t::replace);
}

Result<LaunchOrder> ReadOrder(std::string_view text) {
  try {
    const json object = json::parse(text);
    const auto number = [&object](const char* key) { return object.at(key).get<std::int64_t>(); };
    LaunchOrder order;
    order.program = object.at("program").get<std::string>();
    order.probe_only = object.at("probe").get<bool>();
    order.directory = object.at("directory").get<std::string>();
    WorkerLimits& limits = order.limits;
    limits.memory_bytes = number("memoryBytes");
    limits.cpu_seconds = number("cpuSeconds");
    limits.wall_seconds = number("wallSeconds");
    limits.file_bytes = number("fileBytes");
    limits.open_files = number("openFiles");
    return order;
  } catch (const json::exception& failure) {
    return Error{ErrorCode::kInvalidArgument, std::string("spawner's order: ") + failure.what()};
  }
}

}  // namespace farhorizon
